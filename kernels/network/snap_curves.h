// Moves curve points that would cut slivers to the nearby vertex, before curves are embedded.
#pragma once

#include <cstdint>
#include <span>

#include "engine/data/curve_network.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct SnapOptions {
  Real snap = 0.15;  // edge points nearer than this share of the edge to a vertex move there; 0.5 = paper's snapping
};

// A point on an edge with one end on a sharp chain goes to that end whatever its place, so that creases stay clean.
// Requires: consecutive points of a curve share a face. on_sharp[v] = 1 on vertices of sharp chains (may be empty).
// Ensures: the same, without repeated points and without steps forth and back; curves of one point vanish (their row
// stays, empty). Curve ids and point indices are kept.
void snap_curves(const Work& work, const MeshView& mesh, std::span<const std::uint8_t> on_sharp,
                 const SnapOptions& options, CurveNetwork& curves);

}  // namespace intarsia::kernels
