#include "engine/parallel/scratch_pool.h"
#include "kernels/quality/patch_border.h"

namespace intarsia::kernels {

PatchTriangulations triangulate_patches(const Work& work, const SampledLayout& layout, const LoopsOptions& options) {
  PatchTriangulations out;
  out.triangle.resize(layout.patch_count());
  auto pool = make_scratch_pool([] { return PolygonScratch(); });
  for_each_patch(work, layout, [&](Index p, PatchBorder&& border) {
    if (border.loops() == 0) return;
    const auto scratch = pool.borrow();
    out.triangle[p] = triangulate_loops(border.point, border.offset, border.id, options, *scratch).triangle;
  });
  return out;
}

Reconstruction reconstruct_triangulated(const Work& work, const SampledLayout& layout,
                                        const PatchTriangulations& triangulated) {
  return rebuild(work, layout, [&](Index p, const PatchBorder&) { return PatchMesh{{}, triangulated.triangle[p]}; });
}

}  // namespace intarsia::kernels
