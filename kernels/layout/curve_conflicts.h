// Finds where the curves of a network touch or cross themselves or each other other than in shared points.
#pragma once

#include <utility>
#include <vector>

#include "engine/data/curve_network.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct ConflictOptions {
  Real min_gap = 1e-3;  // share of an edge: two points of an edge must be at least this far apart
};

// Pairs (c, d), c <= d, ascending and without repetition, of curves that are in conflict: two different points on one
// vertex, too close to each other on one edge or at the same place in one face; two segments of a face that cross,
// touch or overlap; two segments between the same two points; consecutive points that share no face (a pair (c, c)). No
// conflict is left <=> the network can be embedded: points that are shared by index are the only contacts. Requires:
// edge points have 0 < a < 1.
std::vector<std::pair<Index, Index>> find_conflicts(const Work& work, MeshView mesh, const CurveNetwork& network,
                                                    const ConflictOptions& options = {});

}  // namespace intarsia::kernels
