// More seeds where the reconstruction is worst (lessons 0.4 and 8): dividing patches up to a wanted number.
#pragma once

#include "kernels/patches/region_error.h"
#include "kernels/patches/split_patches.h"

namespace intarsia::kernels {

struct ErrorSeedOptions {
  SplitOptions split;
  RegionErrorOptions error;
};

// Every patch is approximated by one proxy; then, until there are `target` regions, the region that would be rebuilt
// worst gives its patch one more proxy, and all of that patch are fitted again. Borders of `labels` stay.
// Ensures: every region connected; fewer than `target` only if no patch can be divided.
PatchLabels seed_by_error(const Work& work, const PatchSurface& surface, const PatchLabels& labels, Index target,
                          const ErrorSeedOptions& options);

}  // namespace intarsia::kernels
