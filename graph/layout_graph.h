// The order of the stages, as a flow graph.
#pragma once

#include "engine/run/node.h"
#include "graph/guides.h"
#include "graph/stages.h"

namespace intarsia::graph {

// Where the artefacts of a run can be taken from, by later stages or after the run.
struct FeaturePorts {
  Port<Surface> surface;
  Port<Sharp> sharp;
  Port<Scale> scale;
  Port<Curvature> curvature;
};

struct LayoutPorts {
  FeaturePorts features;
  Port<Ridges> ridges, valleys;
  Port<Curves> curves;
  Port<Goal> goal;
  Port<Network> network;
  Port<Patches> patches;
  Port<Lines> lines;
  Port<Smoothing> smoothing;
  Port<Layout> layout;
};

// Adds surface, sharp, scale, curvature.
FeaturePorts add_feature_stages(Flow& flow, const Port<Soup>& soup, const LayoutOptions& options);

// Adds all stages from surface to layout.
LayoutPorts add_layout_stages(Flow& flow, const Port<Soup>& soup, const LayoutOptions& options,
                              const GuideSource& guides = {});

// Errors: bad_argument naming the option that is out of range.
void check_options(const LayoutOptions& options);

}  // namespace intarsia::graph
