#include "kernels/curves/connect_features.h"

#include <algorithm>
#include <cmath>

#include "kernels/curves/tidy_curves.h"

namespace intarsia::kernels {

CurveOptions paper_curve_options() {
  CurveOptions options;
  options.paper = true;
  options.measure.plain_mean = true;
  options.join.radius = 2;
  return options;
}

FeatureCurves connect_features(const Work& work, const MeshView& mesh, Real edge_length, const FeatureCurves& ridges,
                               const FeatureCurves& valleys, const FeatureCurves& sharp, const CurveOptions& options) {
  const FeatureCurves* channels[] = {&ridges, &valleys, &sharp};
  FeatureCurves curves = merge_channels(channels);
  if (options.paper) {
    measure_curves(work, mesh, options.measure, curves);
    curves = filter_by_length(work, curves, options.paper_filter.min_length);
    join_ends(work, mesh, edge_length, options.join, curves);
    measure_curves(work, mesh, options.measure, curves);
    curves = filter_by_strength(work, curves, options.paper_filter);
    // Turn angles play no part in the choice; later stages want them as the strength of an edge.
    turn_angles(work, mesh, edge_length, options.turn, curves);
    measure_curves(work, mesh, options.measure, curves);
    FilterOptions all;
    all.min_turn = all.min_length = 0, all.min_sharpness = all.folded_sharpness = -1;
    rank_components(work, all, curves);
    return curves;
  }
  for (int twice = 0; twice < 2; ++twice) remove_spurs(work, mesh, options.spur * edge_length, curves);
  const Real fragment = sharp.curve_count() > 0 ? options.fragment : options.fragment_without_sharp;
  remove_fragments(work, mesh, fragment * edge_length, curves);
  turn_angles(work, mesh, edge_length, options.turn, curves);
  join_ends(work, mesh, edge_length, options.join, curves);
  trim_tails(work, options.tail_turn, options.tail_window, curves);
  measure_curves(work, mesh, options.measure, curves);
  // On a coarse mesh the turn is measured over a wider radius, where a round body turns more and a crease does not.
  FilterOptions filter = options.filter;
  filter.min_turn *= std::sqrt(std::max(Real(1), options.turn.radius_in_edges * edge_length / options.turn.radius));
  rank_components(work, filter, curves);
  return curves;
}

}  // namespace intarsia::kernels
