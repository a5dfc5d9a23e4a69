#include "graph/options.h"

namespace intarsia::graph {

LayoutOptions options_up_to(StageGroup group, LayoutOptions o) {
  const LayoutOptions unset;
  if (group < StageGroup::layout) {
    o.smooth = unset.smooth, o.guard_smoothing = unset.guard_smoothing;
    o.cross = unset.cross, o.check = unset.check;
  }
  if (group < StageGroup::patches) o.refine = unset.refine;
  if (group < StageGroup::network) {
    o.form = unset.form, o.seed = unset.seed, o.patches = unset.patches, o.tolerance = unset.tolerance;
    o.choice = unset.choice, o.snap = unset.snap, o.direction = unset.direction, o.extension = unset.extension;
    o.subdivide = unset.subdivide;
  }
  if (group < StageGroup::curves) o.ridges = unset.ridges, o.curves = unset.curves;
  return o;
}

LayoutOptions robust_options() { return {}; }

LayoutOptions paper_options(std::uint64_t seed) {
  LayoutOptions o;
  o.mode = Mode::paper;
  o.form = SubdivideForm::faithful;
  o.seed = seed;
  o.finest_detail = 0;
  o.split_uneven = false;
  o.filter_noise = false;
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
