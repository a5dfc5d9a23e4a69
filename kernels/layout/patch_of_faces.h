// Labels for the faces of the original mesh from those of a refinement.
#pragma once

#include <span>
#include <vector>

#include "engine/data/curve_network.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// For every original face the patch with most of its area; ties (within rounding) go to the smaller patch id.
// Requires: label per refined face. Ensures: kNone only for original faces that no refined face has as parent.
std::vector<Index> patch_of_original_faces(const Work& work, MeshView original, const RefinedMesh& refined,
                                           std::span<const Index> label);

}  // namespace intarsia::kernels
