// Exactly N patches: dividing the worst, or merging the cheapest pair.
#pragma once

#include <string>

#include "kernels/patches/cut_to_discs.h"
#include "kernels/patches/split_patches.h"

namespace intarsia::kernels {

struct ReachOptions {
  bool discs = true;   // keep every patch a disc
  MergeOptions merge;  // keep_discs is ignored: `discs` decides
  SplitOptions split;
  RelaxOptions relax{.passes = 20, .length_weight = 0.4, .fit_normals = false};  // borders of halves of flat patches
  Real flat = 0.02;  // L2,1 energy per area below which a patch is halved by distance, not by normals
};

struct ReachedCount {
  PatchLabels labels;
  std::string reason;  // empty, or why `target` was not reached
};

// Too few: the patch with the largest L2,1 energy (flat ones: area) is halved, again and again. Too many: the cheapest
// pair merges (merge_cost). Any number between the components and the faces of the surface is reached; with `discs`
// only as far as unions stay discs.
// Requires: labels of connected patches.
ReachedCount reach_count(const Work& work, const PatchSurface& surface, const PatchLabels& labels, Index target,
                         const ReachOptions& options);

}  // namespace intarsia::kernels
