#include "kernels/patches/even_cells.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {

EvenCells cut_even_cells(const Work& work, const PatchSurface& s, const PatchLabels& patches,
                         const EvenCellOptions& options) {
  Regions regions(patches);
  const Csr faces = faces_of_patches(patches);
  const auto order = largest_first(faces);
  std::vector<Index> count(patches.count, 1);
  for_each(work, Cost::single, order.size(), [&](std::size_t i) {
    const Index p = order[i];
    Real area = 0;
    for (const Index f : faces.row(p)) area += s.area[f];
    const Real share = s.total_area > 0 ? area / s.total_area * patches.count : 0;
    const Index wanted = std::clamp(static_cast<Index>(std::round(share * options.per_patch)), options.least,
                                    std::max(options.least, options.most));
    if (faces.row(p).size() < 2) return;
    count[p] = divide_region(work, s, {p, 0, faces.row(p)}, wanted, 1, options.relax, regions);
  });
  EvenCells out;
  out.cells = collect_regions(work, regions, count);
  out.patch_of_cell.resize(out.cells.count);
  for (Index f = 0; f < patches.patch_of_face.size(); ++f)
    out.patch_of_cell[out.cells.patch_of_face[f]] = patches.patch_of_face[f];
  return out;
}

}  // namespace intarsia::kernels
