// Joins border vertices that lie at the same place: seams of files that give every part its own vertices.
#pragma once

#include <span>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// vertex -> the vertex it becomes: the smallest of its set, or itself. Empty if nothing is to be joined. Two vertices
// within `distance` of each other along every axis are joined, none that is farther than 2 `distance` along one (but
// for chains). Linear in the number of border vertices, however they lie. border: the vertices that may be joined,
// ascending. low: least coordinates. distance: model units, > 0.
std::vector<Index> weld_borders(const Work& work, const Soup& soup, std::span<const Index> border, const Vec3& low,
                                Real distance);

}  // namespace intarsia::kernels
