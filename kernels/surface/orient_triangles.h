// One orientation for each connected piece of a soup, and cuts where there is none.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/parallel/work.h"
#include "kernels/surface/soup_sides.h"

namespace intarsia::kernels {

struct Orientation {
  std::vector<std::uint8_t> turned;  // per triangle: 1 where its corners must run the other way round
  std::vector<Index> partner;        // per side (3 t + i): the side across, kNone at borders and cuts
  // Edges that were cut, by their smallest triangles, ascending: those of three triangles or more, and those across
  // which no orientation goes.
  std::vector<Index> cut_crowded, cut_unorientable;
};

// Triangles are neighbours across edges of exactly two triangles. A piece keeps the orientation that most of its area
// has; where a piece has none (a Moebius strip), edges are cut along a breadth-first front.
// side: sorted_sides of the corners; area: per triangle.
Orientation orient_triangles(const Work& work, const std::vector<Side>& side, std::span<const Real> area);

}  // namespace intarsia::kernels
