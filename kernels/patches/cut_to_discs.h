// Every patch a disc: patches with several loops, handles or no border at all are divided.
#pragma once

#include "kernels/patches/merge_patches.h"
#include "kernels/patches/regions.h"
#include "kernels/patches/relax_borders.h"

namespace intarsia::kernels {

struct DiscOptions {
  Index most_seeds = 64;  // parts made of one region at a time; parts that are no discs are divided again
  RelaxOptions relax{.passes = 20, .length_weight = 0.4, .fit_normals = false};
  MergeOptions merge{.salience_weight = 0.02, .border_reward = 0.05, .compactness = 0.2, .free_winding = 1.5};
};

// Divides every patch that is no disc by the nearest of 2 + 2 |1 - chi| seeds far apart from each other, repeats that
// with the parts that are no discs, and joins pairs of parts of the same patch, cheapest first, while the union is a
// disc: an annulus ends as two halves. Borders of `labels` stay where they are.
// Ensures: every patch connected, and a disc (a single triangle is one, so this ends); a patch is left as it is only
// where the surface itself touches itself at a vertex.
PatchLabels cut_to_discs(const Work& work, const PatchSurface& surface, const PatchLabels& labels,
                         const DiscOptions& options);

// Divides a region by the nearest of k seeds far apart; the first part keeps the region's label, the others get
// first_new, first_new + 1, ... Returns the number of parts (1 only if the region is a single face).
Index divide_region(const Work& work, const PatchSurface& surface, const Region& region, Index k, Index first_new,
                    const RelaxOptions& relax, Regions& regions);

// V - E + F of one region, short holes filled.
int euler_of_region(const PatchSurface& surface, const Region& region, const Regions& regions);

}  // namespace intarsia::kernels
