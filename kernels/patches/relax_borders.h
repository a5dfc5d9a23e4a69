// Local moves of single faces between the regions of one source: shorter, better-fitting borders without a change of
// topology. A move is made only if the face meets both its old and its new region in one arc, which leaves the Euler
// characteristic of every region as it is; or if it takes a region off a vertex where it touches itself.
#pragma once

#include <vector>

#include "kernels/patches/patch_surface.h"
#include "kernels/patches/regions.h"

namespace intarsia::kernels {

struct RelaxOptions {
  int passes = 20;
  Real length_weight = 0.4;  // price of border length, in mean edge lengths; against A |n - N|^2
  bool fit_normals = true;   // false: length alone counts
};

// Borders between the regions first_label, ..., and `also` (kNone = none) of one source; faces of other labels and of
// other sources stay. `faces` are those of all these regions, ascending.
// Requires: regions.label written. Ensures: connected regions stay connected, none vanishes.
void relax_borders(const Work& work, const PatchSurface& surface, Index source, std::span<const Index> faces,
                   Index first_label, Index also, const RelaxOptions& options, Regions& regions);

}  // namespace intarsia::kernels
