// Patches part by part (in the spirit of de Goes, Goldenstein, Desbrun, Velho 2011, "Exoskeleton: curve network
// abstraction for 3D shapes"): a part segmentation, then variational shape approximation inside every part. Their
// extension of it is not known to us. Section 15.3.
#pragma once

#include <vector>

#include "kernels/baselines/vsa.h"

namespace intarsia::kernels {

// How many patches each part gets: one at least, the others by sqrt(E A), E its energy as one plane; `patches` in all,
// or one a part if there are more parts.
std::vector<Index> share_patches(const FaceGraph& graph, const PatchLabels& parts, Index patches);

// Requires: connected parts. Ensures: every region lies in one part and is connected; ids 0 .. count - 1.
PatchLabels fit_parts(const Work& work, const FaceGraph& graph, const PatchLabels& parts, Index patches);

}  // namespace intarsia::kernels
