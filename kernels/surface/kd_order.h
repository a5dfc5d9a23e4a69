// An order of points in which every aligned run of 8, 16, 32, 64 and 256 points is a compact patch: the groups that
// later kernels work on side by side.
#pragma once

#include <span>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Splits recursively at the median of the longest side of the part's bounding box; split positions are multiples of 256
// while a part is larger than that, then of 64, 32, 16 and 8. Parts of at most 8 are sorted. Points are compared by
// (coordinate on the axis, the other two, rank), so the result depends on the set of points only.
// Requires: coordinates finite, no -0; rank empty (all equal) or one per point; order.size() == point.size().
// Ensures: order is a permutation: place -> point. Returns false if some points agree in position and rank: they were
// then ordered by their number.
bool kd_order(const Work& work, const Vec3View& point, std::span<const Index> rank, std::span<Index> order);

}  // namespace intarsia::kernels
