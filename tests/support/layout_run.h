// A whole run in memory: a soup through the flow graph to the layout, with what was recorded.
#pragma once

#include <memory>
#include <utility>

#include "graph/layout_graph.h"

namespace intarsia::test {

struct LayoutRun {
  std::shared_ptr<const graph::Surface> surface;
  std::shared_ptr<const graph::Network> network;
  std::shared_ptr<const graph::Layout> layout;
  std::vector<StageSummary> stages;
  std::vector<Warning> warnings;
};

inline LayoutRun run_layout(Soup soup, const graph::LayoutOptions& options, const RunSettings& settings = {}) {
  RunContext context(settings);
  Flow flow(context);
  const auto source = [s = std::make_shared<Soup>(std::move(soup))](const Work&) { return *s; };
  const graph::LayoutPorts ports =
      graph::add_layout_stages(flow, add_stage(flow, Stage<Soup>{"read", 1, 0, source}), options);
  keep(ports.features.surface);
  keep(ports.network);
  flow.run();
  return {fetch(ports.features.surface), fetch(ports.network), fetch(ports.layout), flow.record().stages(),
          flow.record().warnings()};
}

// Total length of the layout's arcs of one kind, in diagonals.
inline Real length_of(const graph::Layout& layout, CurveKind kind) {
  Real length = 0;
  for (Index a = 0; a < layout.graph.arc_count(); ++a)
    if (layout.graph.kind[a] == kind) length += layout.graph.length[a];
  return length;
}

}  // namespace intarsia::test
