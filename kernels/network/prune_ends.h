// Removal of what stays loose: a network edge with a free end separates nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Clears active[e] on edges with a vertex that no other active edge uses, again and again. Boundary edges stay.
// Ensures: no vertex has exactly one active edge. Returns the number of edges cleared.
Index prune_ends(const Work& work, const MeshView& mesh, std::vector<std::uint8_t>& active);

}  // namespace intarsia::kernels
