#include "kernels/quality/line_match.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/for_each.h"
#include "engine/parallel/reduce.h"
#include "engine/space/triangle_tree.h"

namespace intarsia::kernels {

namespace {

Real length_of(const Segments& lines, std::size_t s) {
  return (lines.point[lines.end[2 * s + 1]] - lines.point[lines.end[2 * s]]).norm();
}

// Segments as triangles without area.
std::vector<Index> as_triangles(const Segments& lines) {
  std::vector<Index> corner;
  corner.reserve(3 * std::size_t{lines.count()});
  for (Index s = 0; s < lines.count(); ++s)
    corner.insert(corner.end(), {lines.end[2 * s], lines.end[2 * s + 1], lines.end[2 * s + 1]});
  return corner;
}

// Points on each segment that stand for equal parts of it, not longer than `step`.
int pieces_of(Real length, Real step) {
  return std::clamp(static_cast<int>(std::min(step > 0 ? std::ceil(length / step) : 1, 1e6)), 1, 100000);
}

// visit(segment, squared distance, length that the point stands for) for the points of [begin, end).
template <class Visit>
void sample_lines(const Segments& lines, const TriangleTree& other, Real step, std::size_t begin, std::size_t end,
                  const Visit& visit) {
  Index hint = kNone;
  for (std::size_t s = begin; s < end; ++s) {
    const Vec3 a = lines.point[lines.end[2 * s]], b = lines.point[lines.end[2 * s + 1]];
    const Real length = length_of(lines, s);
    const int pieces = pieces_of(length, step);
    for (int i = 0; i < pieces; ++i) {
      const ClosestTriangle found = other.closest(a + ((i + 0.5) / pieces) * (b - a), hint);
      hint = found.triangle;
      visit(s, i, found.distance2, length / pieces);
    }
  }
}

}  // namespace

LineMatch match_lines(const Work& work, const Segments& lines, const Segments& other, Real tolerance) {
  LineMatch match;
  match.length = sum(work, Cost::light, lines.count(), Real{0}, [&](std::size_t s) { return length_of(lines, s); });
  if (other.count() == 0 || lines.count() == 0) return match;
  const std::vector<Index> corner = as_triangles(other);
  const TriangleTree tree(work, {other.point, corner});
  match.near = reduce(
      work, Cost::heavy, lines.count(), Real{0},
      [&](std::size_t begin, std::size_t end) {
        Real near = 0;
        sample_lines(lines, tree, tolerance / 16, begin, end, [&](std::size_t, int, Real distance2, Real length) {
          if (distance2 <= tolerance * tolerance) near += length;
        });
        return near;
      },
      [](Real x, Real y) { return x + y; });
  return match;
}

LineDistance line_distance(const Work& work, const Segments& lines, const Segments& other, Real step) {
  const std::vector<Index> corner = as_triangles(other);
  const TriangleTree tree(work, {other.point, corner});
  std::vector<std::size_t> offset(lines.count() + std::size_t{1}, 0);
  for (std::size_t s = 0; s < lines.count(); ++s)
    offset[s + 1] = offset[s] + static_cast<std::size_t>(pieces_of(length_of(lines, s), step));
  std::vector<std::pair<Real, Real>> sample(offset.back());  // distance, length
  for_each_block(work, Cost::heavy, lines.count(), [&](std::size_t begin, std::size_t end, std::size_t) {
    sample_lines(lines, tree, step, begin, end, [&](std::size_t s, int i, Real distance2, Real length) {
      sample[offset[s] + static_cast<std::size_t>(i)] = {std::sqrt(distance2), length};
    });
  });
  std::sort(sample.begin(), sample.end());
  LineDistance d;
  for (const auto& [distance, length] : sample) d.length += length, d.mean += distance * length;
  if (d.length > 0) d.mean /= d.length;
  Real before = 0;
  for (const auto& [distance, length] : sample) {
    if (before <= 0.5 * d.length) d.median = distance;
    if (before <= 0.9 * d.length) d.high = distance;
    before += length, d.largest = distance;
  }
  return d;
}

}  // namespace intarsia::kernels
