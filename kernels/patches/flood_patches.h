// Patches are the pieces of the surface that the network encloses.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/patch_labels.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Faces connected across edges that are not on the network get the same label.
// Requires: on_network.size() == edge_count().
// Ensures: every patch connected; ids ordered by smallest face.
PatchLabels flood_patches(const Work& work, const MeshView& mesh, std::span<const std::uint8_t> on_network);

// The connected pieces of equal ids; `id` may hold any values.
PatchLabels flood_equal(const Work& work, const MeshView& mesh, std::span<const Index> id);

// Renames ids to 0, 1, ... in order of their smallest face, without a look at connectivity.
// Requires: id[f] < bound.
PatchLabels compact_labels(const Work& work, std::span<const Index> id, Index bound);

// Takes edges off the network that have the same patch on both sides. Boundary edges stay.
// Returns the number of edges taken off.
Index clear_dangling(const Work& work, const MeshView& mesh, const PatchLabels& labels,
                     std::span<std::uint8_t> on_network);

}  // namespace intarsia::kernels
