// Triangles of a mesh that meet where they should not.
#pragma once

#include <cstdint>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"
#include "kernels/surface/fault.h"

namespace intarsia::kernels {

struct SelfIntersections {
  std::uint64_t pairs = 0;
  Fault triangles;  // that are in one of them
};

// Pairs of triangles with a point in common that is not of a corner or an edge that both have: crossing, overlapping in
// a plane, or touching. Corners at the same place count as the same. Triangles without area, and those that repeat
// another, are passed over. Exact: no rounding decides.
// Candidates by boxes of boxes over runs of neighbouring triangles; about n log n where few meet.
// Requires: corners in range, coordinates finite. Ensures: the same for any number of threads.
SelfIntersections self_intersections(const Work& work, const Soup& soup);

}  // namespace intarsia::kernels
