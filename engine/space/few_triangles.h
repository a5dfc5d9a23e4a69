// Distances to a handful of triangles, where building a tree would cost more than it saves.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/lanes.h"

namespace intarsia {

class FewTriangles {
 public:
  // Requires: corners below point.size(); both spans outlive the queries.
  void assign(std::span<const Vec3> point, std::span<const std::array<Index, 3>> triangle);

  // The least squared distance of p to a triangle, bit by bit that of closest_on_triangle(). All are estimated side by
  // side, and those asked exactly that are within the estimate's error of the nearest. Requires: a triangle.
  Real distance2(const Vec3& p) { return nearest(p).distance2; }

  struct Nearest {
    Real distance2;
    std::size_t triangle;
    Vec3 point;
  };
  // The same with where it is. Ties: the smaller triangle.
  Nearest nearest(const Vec3& p);

 private:
  std::span<const Vec3> point_;
  std::span<const std::array<Index, 3>> triangle_;
  Real slack_ = 0;  // squared length: error of an estimate
  // Corner a, the sides to b and c, and what the projection to sides and plane needs: fields of whole lanes.
  LaneArray field_;
  LaneArray estimate_;
  std::vector<Index> thin_;  // no estimate of these is any good: always asked
};

}  // namespace intarsia
