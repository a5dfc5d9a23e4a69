#include "graph/options.h"

namespace intarsia::graph {

LayoutOptions robust_options() { return {}; }

LayoutOptions paper_options(std::uint64_t seed) {
  LayoutOptions o;
  o.mode = Mode::paper;
  o.form = SubdivideForm::faithful;
  o.seed = seed;
  o.barrier = false;
  o.sharp.enabled = false;
  o.scale = kernels::ScaleOptions::paper();
  o.curvature = kernels::CurvatureOptions::paper();
  o.ridges = kernels::RidgeOptions::paper();
  o.curves = kernels::paper_curve_options();
  o.choice.most_patches = kNone;
  o.direction.smoothing = 0;
  o.extension.cone = 60;
  o.extension.feedback = 0;
  o.extension.meet_rings = 1;
  o.extension.paper_queue = true;
  o.subdivide = kernels::paper_subdivision(seed);
  o.smooth.nearest_direction = false;
  o.guard_smoothing = false;
  return o;
}

}  // namespace intarsia::graph
