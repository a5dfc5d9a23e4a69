// Extension of all loose curve ends together until they meet other curves (Cao, Yan, Wonka 2014, 3.4).
#pragma once

#include <cstdint>
#include <vector>

#include "engine/parallel/work.h"
#include "kernels/network/extension_cost.h"

namespace intarsia::kernels {

struct ExtensionResult {
  std::vector<Index> edge;  // refined edges added to the network, in order of end id and step
  Index ends = 0;           // loose ends at the start
  Index met = 0;            // ends that reached a curve or the boundary
  Index bridged = 0;        // ends that took the shortest way instead
  Index dead = 0;           // ends left loose (pruned later)
};

// active[e] = 1 on the refined edges that form the network (features and boundary). A loose end is a vertex with
// exactly one active edge.
// Ensures: added edges are new to the network; two chains never cross (they can only meet in a vertex); with the fixed
// order the result is a function of the input alone.
ExtensionResult extend_curves(const Work& work, const RefinedMesh& refined, std::span<const std::uint8_t> active,
                              const Terrain& terrain, const ExtensionOptions& options);

}  // namespace intarsia::kernels
