// A network without curves: what methods that do not look at features start from.
#pragma once

#include "engine/parallel/work.h"
#include "graph/artefacts.h"

namespace intarsia::graph {

// The surface's own mesh as a refinement of itself, its boundary as the only network.
Network empty_network(const Work& work, const Surface& surface);

// Patches of a segmentation of the surface's faces: every connected piece of equal labels is a patch.
// Requires: one label per face.
Patches patches_of_labels(const Work& work, const Network& network, const Surface& surface,
                          std::span<const Index> label);

}  // namespace intarsia::graph
