#include "engine/space/outline.h"

#include <algorithm>
#include <cmath>

namespace intarsia {
namespace {

Real length_of(std::span<const Vec3> p) {
  Real length = 0;
  for (std::size_t i = 1; i < p.size(); ++i) length += (p[i] - p[i - 1]).norm();
  return length;
}

// Appends the start and the inner points of `steps` even steps along p; not its end.
// inward may be empty; at the start there is no one direction.
void sample_piece(std::span<const Vec3> p, std::span<const Vec3> inward, Real length, Index steps,
                  std::vector<Vec3>& out, std::vector<Vec3>& out_inward) {
  out.push_back(p.front());
  if (!inward.empty()) out_inward.push_back(Vec3::Zero());
  Real before = 0;
  std::size_t i = 1;
  for (Index k = 1; k < steps; ++k) {
    const Real at = length * k / steps;
    Real step = (p[i] - p[i - 1]).norm();
    while (before + step < at && i + 1 < p.size()) {
      before += step, ++i;
      step = (p[i] - p[i - 1]).norm();
    }
    const Real t = step > 0 ? std::clamp((at - before) / step, Real{0}, Real{1}) : 0;
    out.push_back(p[i - 1] + t * (p[i] - p[i - 1]));
    if (inward.empty()) continue;
    const Vec3 m = inward[i - 1] + t * (inward[i] - inward[i - 1]);
    const Real size = m.norm();
    out_inward.push_back(size > 0.5 ? Vec3(m / size) : Vec3(Vec3::Zero()));
  }
}

void sample_loops(const Outline& o, Index loop_points, OutlineScratch& s) {
  s.point.clear(), s.inward.clear();
  s.offset.assign(1, 0);
  const std::span<const Vec3> all = o.point;
  const auto piece = [&](Index k) { return all.subspan(o.piece[k], o.piece[k + 1] - o.piece[k]); };
  const auto inward = [&](Index k) {
    return o.inward.empty() ? std::span<const Vec3>()
                            : std::span(o.inward).subspan(o.piece[k], o.piece[k + 1] - o.piece[k]);
  };
  Real longest = 0, total = 0;
  for (Index l = 0; l < o.loops(); ++l) {
    Real length = 0;
    for (Index k = o.loop[l]; k < o.loop[l + 1]; ++k) length += length_of(piece(k));
    longest = std::max(longest, length), total += length;
  }
  longest = std::max(longest, total / 2);  // many loops share the points of two: time grows with their cube
  for (Index l = 0; l < o.loops(); ++l) {
    const Index pieces = o.loop[l + 1] - o.loop[l];
    const Index least = pieces == 1 ? 8 : pieces == 2 ? 2 : 1;
    for (Index k = o.loop[l]; k < o.loop[l + 1]; ++k) {
      const Real length = length_of(piece(k));
      const Real wanted = longest > 0 ? std::round(length / longest * loop_points) : 1;
      sample_piece(piece(k), inward(k), length, std::max(least, static_cast<Index>(wanted)), s.point, s.inward);
    }
    s.offset.push_back(static_cast<Index>(s.point.size()));
  }
}

// bent: nullptr for none.
Real sum_of_squares(const WeightedPoints& samples, FewTriangles& triangles, const BentTriangles* bent, Real weight) {
  Real sum = 0;
  for (std::size_t i = 0; i < samples.point.size(); ++i) {
    const FewTriangles::Nearest at = triangles.nearest(samples.point[i]);
    Real d2 = at.distance2;
    if (bent) d2 += weight * (samples.point[i] - at.point - bent->offset_at(at.triangle, at.point)).squaredNorm();
    sum += samples.weight[i] * d2;
  }
  return sum;
}

// With so many points; negative if there is no triangulation.
Real sampled_error(const Outline& outline, const WeightedPoints& samples, Index points, Real bend,
                   const OutlineOptions& options, OutlineScratch& s) {
  if (points == 0 || outline.loops() == 0) return -1;
  sample_loops(outline, points, s);
  LoopsOptions loops = options.loops;
  loops.polygon.bend_weight *= bend;
  const LoopsTriangulation t = triangulate_loops(s.point, s.offset, {}, loops, s.polygon);
  if (!t.ok || t.triangle.empty()) return -1;
  s.triangles.assign(s.point, t.triangle);
  if (s.inward.empty() || options.bent == 0) return sum_of_squares(samples, s.triangles, nullptr, 0);
  s.bent.assign(s.point, s.inward, s.offset, t.triangle);
  return sum_of_squares(samples, s.triangles, &s.bent, options.bent);
}

}  // namespace

Real Outline::length() const {
  Real total = 0;
  for (std::size_t k = 0; k + 1 < piece.size(); ++k)
    total += length_of(std::span(point).subspan(piece[k], piece[k + 1] - piece[k]));
  return total;
}

Real coarse_outline_error(const Outline& outline, const WeightedPoints& samples, const OutlineOptions& options,
                          OutlineScratch& s) {
  if (samples.point.empty()) return 0;
  return sampled_error(outline, samples, options.second_points, options.second_bend, options, s);
}

Real outline_error(const Outline& outline, const WeightedPoints& samples, const OutlineOptions& options,
                   OutlineScratch& s, std::optional<Real> coarse) {
  if (samples.point.empty()) return 0;
  if (!coarse) coarse = coarse_outline_error(outline, samples, options, s);
  const Real worse = std::max(*coarse, sampled_error(outline, samples, options.loop_points, 1, options, s));
  if (worse >= 0) return worse;
  Vec3 mean = Vec3::Zero();
  Real weight = 0;
  for (std::size_t i = 0; i < samples.point.size(); ++i)
    mean += samples.weight[i] * samples.point[i], weight += samples.weight[i];
  if (weight > 0) mean /= weight;
  Real sum = 0;
  for (std::size_t i = 0; i < samples.point.size(); ++i)
    sum += samples.weight[i] * (samples.point[i] - mean).squaredNorm();
  return sum;
}

void smooth_polyline(std::span<Vec3> p, int steps) {
  if (p.size() < 3) return;
  for (int k = 0; k < steps; ++k) {
    Vec3 before = p[0];
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
      const Vec3 here = p[i];
      p[i] = 0.5 * here + 0.25 * (before + p[i + 1]);
      before = here;
    }
  }
}

}  // namespace intarsia
