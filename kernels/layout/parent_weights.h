// Refined faces seen from their parents, in barycentric terms: exact for thin parents too.
#pragma once

#include <optional>

#include "engine/data/curve_network.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// True if refined face f is its whole parent: the same corners in the same order.
bool is_uncut(const MeshView& original, const RefinedMesh& refined, Index f);

// The signed share of its parent's area that a refined face covers (1 for an uncut face); empty if one of its corners
// does not lie on the parent.
std::optional<Real> share_of_parent(const MeshView& original, const RefinedMesh& refined, Index f);

// Original face -> its refined faces, ascending. Parents out of range are skipped.
Csr children_of_parents(const Work& work, Index original_faces, const RefinedMesh& refined);

}  // namespace intarsia::kernels
