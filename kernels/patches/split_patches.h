// Dividing patches whose normals spread too far (the paper's pi/2 rule; ours leaves out a share of the area at each
// end).
#pragma once

#include <cstdint>
#include <numbers>

#include "kernels/patches/fit_proxies.h"
#include "kernels/patches/relax_borders.h"

namespace intarsia::kernels {

struct SplitOptions {
  Real max_spread = std::numbers::pi / 2;  // radians (paper)
  Real trim = 0.08;                        // share of the area left out at each end of the spread
  Real least_area = 1.6e-3;                // of the whole surface: smaller regions stay, their halves would be tiny
  bool literal = false;                    // paper: any two triangles decide, not the trimmed spread
  bool random_seeds = false;               // paper: two random first seeds, keyed by (seed, patch)
  std::uint64_t seed = 0;
  int smoothing = 6;  // rounds of averaging of the normals that regions grow by; 0 = none (paper)
  ProxyOptions fit;
  RelaxOptions relax;
};

// The paper's own values.
SplitOptions paper_split(std::uint64_t seed);

// Patches whose spread is too large become regions by variational shape approximation from two seeds, with one more
// seed in the worst region until every region complies. From eight regions on only the worst one and its neighbours are
// fitted again (all of them each time their number doubles), beyond 64 the worst one alone. Flat patches stay whole.
// Patches are independent of each other and of the number of threads. Ensures: every patch connected; no border of
// `labels` is moved or lost.
PatchLabels split_patches(const Work& work, const PatchSurface& surface, const PatchLabels& labels,
                          const SplitOptions& options);

// Approximation of one region by exactly `count` proxies (fewer only if it has fewer nodes); writes regions.label and
// returns the number of regions. `normal`: smooth_normals of the surface.
Index approximate_region(const Work& work, const PatchSurface& surface, const FaceVectors& normal, const Region& region,
                         Index count, const SplitOptions& options, Regions& regions);

}  // namespace intarsia::kernels
