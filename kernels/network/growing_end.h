// A loose end of the network and the path that leads to it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/curve_network.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct GrowingEnd {
  std::vector<Index> path;  // vertices, oldest first; the tip is last
  std::size_t start = 0;    // path[start] is the end as found; later ones are appended
  CurveKind channel = CurveKind::ridge;
  Vec3 tracer = Vec3::Zero();  // y: the point of the ideal curve beside the tip
  Real grown = 0;              // length appended so far
  std::uint8_t closed = 0;
};

// The vertices with exactly one active edge that are not on the boundary, ascending, each with the path that leads to
// it: back along the network over vertices with two active edges, for at most `history` of length.
std::vector<GrowingEnd> find_ends(const Work& work, const RefinedMesh& refined, std::span<const std::uint8_t> active,
                                  Real history);

}  // namespace intarsia::kernels
