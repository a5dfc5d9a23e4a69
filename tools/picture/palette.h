// Colours of patches: calm, and different across every border.
#pragma once

#include <span>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"
#include "tools/picture/image.h"

namespace intarsia::tools {

// patch -> patches it shares an edge with, ascending, without itself. Faces labelled kNone are ignored.
// Requires: labels below patches; edges of the mesh filled.
Csr adjacent_patches(const Work& work, const MeshView& mesh, std::span<const Index> patch_of_face, Index patches);

// One colour per patch from a fixed set of medium-light colours (even steps of hue in OKLab, Ottosson 2020), chosen
// greedily: patches with many neighbours first, each as far as possible from its neighbours, a little from their
// neighbours, and from what is used most. Depends on the adjacency only.
// Requires: rows symmetric and without the patch itself.
// Ensures: neighbours differ.
std::vector<Rgb> patch_colours(const Work& work, CsrView adjacency);

}  // namespace intarsia::tools
