#include "kernels/curves/filter_curves.h"

#include <algorithm>

#include "engine/parallel/union_find.h"
#include "kernels/curves/tidy_curves.h"

namespace intarsia::kernels {

namespace {

template <class Keep>
FeatureCurves keep_if(const Work& work, const FeatureCurves& curves, const Keep& keep) {
  std::vector<std::uint8_t> kept(curves.curve_count());
  for (Index c = 0; c < curves.curve_count(); ++c) kept[c] = keep(c) ? 1 : 0;
  return select_curves(work, curves, kept);
}

// Mean sharpness over the points of a curve, each limited so that one bad fit cannot decide.
Real mean_sharpness(const FeatureCurves& curves, Index c) {
  const auto row = curves.points_of(c);
  Real sum = 0;
  for (Index p : row) sum += std::clamp(curves.sharpness[p], Real(-1), Real(2));
  return sum / static_cast<Real>(row.size());
}

Real needed_sharpness(Real turn, const FilterOptions& options) {
  const Real range = std::max(options.folded_turn - options.unfolded_turn, Real(1e-9));
  const Real folded = std::clamp((turn - options.unfolded_turn) / range, Real(0), Real(1));
  return (1 - folded) * options.min_sharpness + folded * options.folded_sharpness;
}

}  // namespace

void rank_components(const Work& work, const FilterOptions& options, FeatureCurves& curves) {
  const Index count = curves.curve_count();
  UnionFind sets(curves.point_count());
  for (Index c = 0; c < count; ++c)
    for (Index p : curves.points_of(c)) sets.unite(curves.points_of(c).front(), p);
  work.check();
  std::vector<Index> number(curves.point_count(), kNone);
  curves.component.assign(count, 0);
  Index components = 0;
  for (Index c = 0; c < count; ++c) {
    Index& n = number[sets.find(curves.points_of(c).front())];
    if (n == kNone) n = components++;
    curves.component[c] = n;
  }
  std::vector<Real> length(components, 0), crest_length(components, 0), turn(components, 0), sharpness(components, 0);
  std::vector<std::uint8_t> sharp(components, 0);
  curves.component_saliency.assign(components, 0);
  curves.component_passed.assign(components, 0);
  for (Index c = 0; c < count; ++c) {
    const Index n = curves.component[c];
    curves.component_saliency[n] += curves.saliency[c];
    length[n] += curves.length[c];
    if (curves.net.kind[c] == CurveKind::sharp) {
      sharp[n] = 1;
      continue;
    }
    crest_length[n] += curves.length[c];
    turn[n] += curves.saliency[c];
    sharpness[n] += curves.length[c] * mean_sharpness(curves, c);
  }
  for (Index n = 0; n < components; ++n) {
    const Real mean_turn = crest_length[n] > 0 ? turn[n] / crest_length[n] : 0;
    const bool stands_out = mean_turn >= options.min_turn && crest_length[n] > 0 &&
                            sharpness[n] >= needed_sharpness(mean_turn, options) * crest_length[n];
    if (stands_out && length[n] >= options.min_length) curves.component_passed[n] = 1;
    if (stands_out && sharp[n]) curves.component_passed[n] = 2;
  }
}

FeatureCurves filter_by_saliency(const Work& work, const FeatureCurves& ranked, Real min_saliency) {
  return keep_if(work, ranked, [&](Index c) {
    const Index n = ranked.component[c];
    const auto passed = ranked.component_passed[n];
    return ranked.net.kind[c] == CurveKind::sharp || passed == 2 ||
           (passed == 1 && ranked.component_saliency[n] >= min_saliency);
  });
}

FeatureCurves filter_by_length(const Work& work, const FeatureCurves& measured, Real min_length) {
  return keep_if(work, measured, [&](Index c) { return measured.length[c] >= min_length; });
}

FeatureCurves filter_by_strength(const Work& work, const FeatureCurves& measured, const PaperFilterOptions& options) {
  return keep_if(work, measured, [&](Index c) {
    return measured.rms_curvature[c] >= options.min_curvature && measured.strength[c] >= options.min_strength;
  });
}

}  // namespace intarsia::kernels
