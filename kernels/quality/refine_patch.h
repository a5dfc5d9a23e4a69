// A triangulation that only has points on its border, given points inside (Liepa 2003, "Filling holes in meshes").
#pragma once

#include <array>
#include <vector>

#include "engine/base/types.h"

namespace intarsia::kernels {

struct RefineOptions {
  Real step = 1;           // border steps between the inner points
  Index most_inner = 800;  // about
  int rounds = 14;
};

// Border edges stay; inner edges are flipped where the two angles opposite to them add up to more than pi. Points on
// the plane z = 0 give a Delaunay triangulation in which no edge is longer than it must be.
// point: those of the border first; inner points are appended. Triangles are replaced.
// Requires: consistently oriented triangles.
void refine_patch(std::vector<Vec3>& point, std::vector<std::array<Index, 3>>& triangle, const RefineOptions& options);

}  // namespace intarsia::kernels
