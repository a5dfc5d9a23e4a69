// The methods that layouts are compared with: segmentations of the surface that do not look at feature curves, brought
// to patches and then to a layout by the same last stages as our own (section 15).
#pragma once

#include <span>
#include <vector>

#include "graph/empty_network.h"

namespace intarsia::graph {

enum class Baseline : std::uint8_t {
  vsa,  // variational shape approximation, Cohen-Steiner, Alliez, Desbrun 2004
};

// One label per face of the surface; every label connected, `patches` of them where the surface allows.
std::vector<Index> baseline_labels(const Work& work, const Surface& surface, Baseline method, Index patches);

// The same as patches. network: empty_network of the surface.
Patches baseline_patches(const Work& work, const Surface& surface, const Network& network, Baseline method,
                         Index patches);

}  // namespace intarsia::graph
