// More seeds where the reconstruction is worst: dividing patches up to a wanted number.
#pragma once

#include "kernels/patches/region_error.h"
#include "kernels/patches/split_patches.h"

namespace intarsia::kernels {

struct ErrorSeedOptions {
  SplitOptions split;
  RegionErrorOptions error;
};

// Every patch is approximated by one proxy; then, until there are `target` regions, the region that would be rebuilt
// worst gives its patch one more proxy, and others of that patch are fitted again. Borders of `labels` stay. Time:
// about linear in the faces and the target; a patch of 64 regions falls apart into as many patches. Ensures: every
// region connected; fewer than `target` only if no patch can be divided.
PatchLabels seed_by_error(const Work& work, const PatchSurface& surface, const PatchLabels& labels, Index target,
                          const ErrorSeedOptions& options);

}  // namespace intarsia::kernels
