// Patches cut into small even cells, the pieces that change sides when borders are refined.
#pragma once

#include "kernels/patches/cut_to_discs.h"

namespace intarsia::kernels {

struct EvenCellOptions {
  Index per_patch = 20;  // of a patch of average area
  Index least = 8;       // in every patch
  Index most = 80;
  RelaxOptions relax{.passes = 20, .length_weight = 0.4, .fit_normals = false};
};

struct EvenCells {
  PatchLabels cells;
  std::vector<Index> patch_of_cell;
};

// Every patch by the nearest of k points far apart along the surface. Ensures: every cell connected and inside one
// patch.
EvenCells cut_even_cells(const Work& work, const PatchSurface& surface, const PatchLabels& patches,
                         const EvenCellOptions& options);

}  // namespace intarsia::kernels
