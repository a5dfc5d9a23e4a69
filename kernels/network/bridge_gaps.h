// The way out for ends that found no candidate: the shortest way along the direction field to any other curve.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/network/extension_cost.h"
#include "kernels/network/growing_end.h"

namespace intarsia::kernels {

// For every open end, in order: Dijkstra 1959 over mesh edges with cost |e| (1 + 2 c (1 - (e.x)^2)), x the field
// direction and c its confidence, to the nearest vertex of the network that is not its own tail, the first edge within
// 90 degrees of the walking direction, at most options.max_gap long. Paths are appended and taken; returns how many.
Index bridge_gaps(const Work& work, const Terrain& terrain, const ExtensionOptions& options,
                  std::vector<std::uint8_t>& taken, std::vector<GrowingEnd>& ends);

}  // namespace intarsia::kernels
