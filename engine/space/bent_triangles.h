// A triangulation of loops bent so that it leaves the loops in given directions: a quick guess at the smooth surface
// that would be filled in.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/types.h"

namespace intarsia {

// Cubic Bezier triangles over flat ones as in Vlachos, Peters, Boyd, Mitchell 2001 ("Curved PN triangles"), but with
// the tangents of their sides turned into the inward directions instead of projected: steep directions keep their
// length. Sides that follow a loop stay straight.
class BentTriangles {
 public:
  // inward: per point, unit length and normal to the loop, or zero: straight there. offset: loop -> first point.
  void assign(std::span<const Vec3> point, std::span<const Vec3> inward, std::span<const Index> offset,
              std::span<const std::array<Index, 3>> triangle);
  // How far the bent triangle is from the flat one at point q of that.
  Vec3 offset_at(std::size_t triangle, const Vec3& q) const;

 private:
  struct Bend {
    Vec3 side[3][2];  // control points of the side from corner i to the next one, minus those of the flat triangle
    Vec3 middle;
  };
  std::span<const Vec3> point_;
  std::span<const std::array<Index, 3>> triangle_;
  std::vector<Index> next_;
  std::vector<Vec3> along_;
  std::vector<Bend> bend_;
};

}  // namespace intarsia
