#include "engine/run/trace.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace intarsia {

nlohmann::json chrome_trace(const std::vector<TracedRun>& runs) {
  using nlohmann::json;
  json events = json::array();
  struct Entry {
    std::size_t run;
    Real start;
    NodeRecord node;
  };
  std::vector<Entry> entries;
  Real first = runs.empty() ? 0 : runs.front().record->start();
  for (const TracedRun& run : runs) first = std::min(first, run.record->start());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    events.push_back(
        {{"name", "process_name"}, {"ph", "M"}, {"pid", r}, {"tid", 0}, {"args", {{"name", runs[r].name}}}});
    for (NodeRecord& node : runs[r].record->nodes())
      entries.push_back({r, runs[r].record->start() - first + node.start, std::move(node)});
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.start < b.start; });
  for (const auto& [run, start, node] : entries)
    events.push_back(
        {{"name", node.branch.empty() ? node.stage : node.branch},
         {"cat", node.stage},
         {"ph", "X"},
         {"ts", start * 1e6},
         {"dur", node.wall * 1e6},
         {"pid", run},
         {"tid", node.thread},
         {"args",
          {{"items", node.items}, {"bytes", node.bytes}, {"hash", hex_text(node.hash)}, {"cpu_seconds", node.cpu}}}});
  return {{"traceEvents", std::move(events)}, {"displayTimeUnit", "ms"}};
}

}  // namespace intarsia
