#include "kernels/quality/patch_border.h"

namespace intarsia::kernels {

Reconstruction reconstruct_triangulated(const Work& work, const SampledLayout& layout, const LoopsOptions& options) {
  return rebuild(work, layout, [&](Index, const PatchBorder& border, PolygonScratch& scratch) {
    return triangulate_border(border, options, scratch);
  });
}

}  // namespace intarsia::kernels
