// How badly a region would be rebuilt from its border alone: what decides where the next seed goes.
#pragma once

#include "engine/space/outline.h"
#include "kernels/patches/patch_surface.h"
#include "kernels/patches/regions.h"

namespace intarsia::kernels {

struct RegionErrorOptions {
  Index samples = 160;  // faces that stand for the region
  int smoothing = 10;   // steps of averaging of borders that are no features
  OutlineOptions outline;
};

struct RegionErrorScratch {
  std::vector<Index> border, seen;
  Outline outline;
  WeightedPoints samples;
  OutlineScratch error;
};

// Loops of border edges in order, region on the left, as polylines with corners where the region across changes or a
// feature or the boundary turns. Holes of the surface that count as filled are left out.
void region_outline(const PatchSurface& surface, const Region& region, const Regions& regions, int smoothing,
                    RegionErrorScratch& scratch);

// Estimate of the integral of the squared distance between the region and its reconstruction.
Real region_error(const PatchSurface& surface, const Region& region, const Regions& regions,
                  const RegionErrorOptions& options, RegionErrorScratch& scratch);

}  // namespace intarsia::kernels
