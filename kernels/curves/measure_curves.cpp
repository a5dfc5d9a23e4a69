#include "kernels/curves/measure_curves.h"

#include <cmath>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {

void measure_curves(const Work& work, const MeshView& mesh, const MeasureOptions& options, FeatureCurves& curves) {
  const auto& item = curves.net.curve.item;
  const Index count = curves.curve_count();
  // Contributions of the segment from item i to item i + 1; those across two curves are never read.
  std::vector<Real> length(item.size(), 0), curvature(item.size(), 0), extremality(item.size(), 0),
      turn(item.size(), 0);
  const auto rms = [&](Index p) {
    return std::sqrt(0.5 * (curves.kmax[p] * curves.kmax[p] + curves.kmin[p] * curves.kmin[p]));
  };
  for_each(work, Cost::light, item.empty() ? 0 : item.size() - 1, [&](std::size_t i) {
    const Index p = item[i], q = item[i + 1];
    length[i] = (position(mesh, curves.net.point[q]) - position(mesh, curves.net.point[p])).norm();
    curvature[i] = 0.5 * length[i] * (rms(p) + rms(q));
    extremality[i] = 0.5 * length[i] * (curves.extremality[p] + curves.extremality[q]);
    turn[i] = 0.5 * length[i] * (curves.turn()[p] + curves.turn()[q]);
  });
  curves.length.assign(count, 0), curves.rms_curvature.assign(count, 0);
  curves.strength.assign(count, 0), curves.saliency.assign(count, 0);
  for_each(work, Cost::heavy, count, [&](std::size_t c) {
    Real l = 0, r = 0, e = 0, s = 0;
    const Index begin = curves.net.curve.offset[c], end = curves.net.curve.offset[c + 1];
    for (Index i = begin; i + 1 < end; ++i) l += length[i], r += curvature[i], e += extremality[i], s += turn[i];
    Real mean = l > 0 ? r / l : 0;
    if (options.plain_mean) {
      const bool closed = curves.net.is_closed(static_cast<Index>(c));
      const Index last = closed ? end - 1 : end;  // the repeated point counts once
      mean = 0;
      for (Index i = begin; i < last; ++i) mean += rms(item[i]);
      mean /= last - begin;
    }
    curves.length[c] = l, curves.rms_curvature[c] = mean, curves.strength[c] = l * e, curves.saliency[c] = s;
  });
}

}  // namespace intarsia::kernels
