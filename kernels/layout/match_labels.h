// Carries patch ids from one refinement of a mesh to another one, whose patch borders have moved a little.
#pragma once

#include <span>
#include <vector>

#include "engine/data/layout_graph.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct LabelMatch {
  std::vector<Index> old_of_new;  // new component -> old patch, kNone if it overlaps none
  std::vector<Index> trouble;     // old patches, ascending, that are lost, split, or changed beyond recognition
  bool ok = false;                // one component for each old patch and no trouble
};

// How the faces of the original mesh are divided among labels.
struct LabelShares {
  std::vector<Index> whole;   // original face -> its only label, or kNone
  std::vector<Index> face;    // those with several labels or none, ascending
  std::vector<Index> offset;  // place in `face` -> its part of the following two
  std::vector<Index> label;   // ascending
  std::vector<Real> share;    // of the face's area
};

// Requires: one label per refined face.
LabelShares label_shares(const Work& work, MeshView original, const RefinedMesh& refined, std::span<const Index> label);

// Every new component gets the old patch it shares most area with. Parents that are cut count by the product of the two
// shares of their area. An old patch is in trouble if it does not get exactly one component, or if that component
// shares less than half of the patch's area. Requires: labels per refined face, below the given counts.
LabelMatch match_labels(const Work& work, MeshView original, const LabelShares& old, Index old_count,
                        const RefinedMesh& new_refined, std::span<const Index> new_label, Index new_count);
LabelMatch match_labels(const Work& work, MeshView original, const RefinedMesh& old_refined,
                        std::span<const Index> old_label, Index old_count, const RefinedMesh& new_refined,
                        std::span<const Index> new_label, Index new_count);

// One flag per arc: 1 if a patch in trouble lies on either side. For cross_edges(keep_chain).
std::vector<std::uint8_t> arcs_of_patches(const LayoutGraph& graph, std::span<const Index> patches);

// The patches, ascending, that should meet or do meet along refined edges whose arc does not have exactly its own two
// patches on its sides; empty if every arc is in its place. Even with a perfect match this can happen, where an arc was
// pulled to the other side of a thin handle.
// edge, edge_curve: the pairs of Embedding, curve = arc. patch_of_face: old patch ids on the new refinement.
std::vector<Index> patches_out_of_place(const Work& work, const LayoutGraph& graph, MeshView new_refined,
                                        std::span<const Index> patch_of_face, std::span<const Index> edge,
                                        std::span<const Index> edge_curve);

}  // namespace intarsia::kernels
