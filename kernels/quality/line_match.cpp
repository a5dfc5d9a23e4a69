#include "kernels/quality/line_match.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/reduce.h"
#include "engine/space/triangle_tree.h"

namespace intarsia::kernels {

LineMatch match_lines(const Work& work, const Segments& lines, const Segments& other, Real tolerance) {
  LineMatch match;
  const auto length_of = [&](std::size_t s) {
    return (lines.point[lines.end[2 * s + 1]] - lines.point[lines.end[2 * s]]).norm();
  };
  match.length = sum(work, Cost::light, lines.count(), Real{0}, length_of);
  if (other.count() == 0 || lines.count() == 0) return match;
  std::vector<Index> corner;  // segments as triangles without area
  corner.reserve(3 * std::size_t{other.count()});
  for (Index s = 0; s < other.count(); ++s)
    corner.insert(corner.end(), {other.end[2 * s], other.end[2 * s + 1], other.end[2 * s + 1]});
  const TriangleTree tree(work, {other.point, corner});
  match.near = reduce(
      work, Cost::heavy, lines.count(), Real{0},
      [&](std::size_t begin, std::size_t end) {
        Real near = 0;
        Index hint = kNone;
        for (std::size_t s = begin; s < end; ++s) {
          const Vec3 a = lines.point[lines.end[2 * s]], b = lines.point[lines.end[2 * s + 1]];
          const Real length = length_of(s), wanted = tolerance > 0 ? 16 * length / tolerance : 1;
          const int pieces = std::clamp(static_cast<int>(std::min(wanted, 1e6)), 1, 100000);
          for (int i = 0; i < pieces; ++i) {
            const ClosestTriangle found = tree.closest(a + ((i + 0.5) / pieces) * (b - a), hint);
            hint = found.triangle;
            if (found.distance2 <= tolerance * tolerance) near += length / pieces;
          }
        }
        return near;
      },
      [](Real x, Real y) { return x + y; });
  return match;
}

}  // namespace intarsia::kernels
