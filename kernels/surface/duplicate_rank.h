// Tells vertices at exactly the same position apart by what surrounds them, not by their number.
#pragma once

#include <span>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// A number per vertex: 0 unless the position is shared; different for vertices at the same position. Colours start from
// positions and are refined by the colours of the incident faces' corners (after Weisfeiler, Leman 1968, with sums of
// hashes, which do not depend on order) until nothing new is told apart, at most 64 times. What is left are copies of
// the same surroundings: they are ranked by the smallest vertex of their component, then by number, so whole identical
// components may be exchanged without a trace.
// Requires: coordinates finite, no -0; corner ids below point.size().
// Ensures: for any order of vertices and faces the same ranks up to exchanging identical components. Not promised: one
// component that covers itself exactly and repeats all around (a strip wound twice over itself).
std::vector<Index> duplicate_rank(const Work& work, const Vec3View& point, std::span<const Index> corner);

}  // namespace intarsia::kernels
