// Rebuilding a surface from the curve network of a layout alone (sections 12 and 13): what a layout is judged by.
// Three ways: optimal triangulations of the loops, transfinite patches, and thin-plate fills that also take the input's
// normals along the arcs.
#pragma once

#include <array>
#include <vector>

#include "engine/space/triangulate_loops.h"
#include "kernels/quality/sample_layout.h"

namespace intarsia::kernels {

// One watertight triangle surface; patch per triangle. Points are shared along arcs; every edge of an arc is used once
// by the patches on its sides.
struct Reconstruction {
  Vec3Array point;                    // those of the samples first
  std::vector<Index> corner, patch;   // patch per triangle, ascending
  std::vector<std::uint8_t> bridged;  // per patch: it has several loops
  std::vector<std::uint8_t> failed;   // per patch: it was left out (no loop, no triangulation) or, in the fills, fell
                                      // back to its triangulation
  std::vector<std::uint8_t> cut;      // per patch: transfinite patches only, it was cut into parts
  Index bridged_count() const;
  Index cut_count() const;
  Index failed_count() const;
};

// Optimal triangulations of the loops of every patch (Zou, Ju, Carr 2013). Corners are positions in the concatenated
// loops of the patch; none where there is no loop or no triangulation.
struct PatchTriangulations {
  std::vector<std::vector<std::array<Index, 3>>> triangle;  // per patch
};
PatchTriangulations triangulate_patches(const Work& work, const SampledLayout& layout, const LoopsOptions& options);

// That triangulation as a surface.
Reconstruction reconstruct_triangulated(const Work& work, const SampledLayout& layout,
                                        const PatchTriangulations& triangulated);

struct TransfiniteOptions {
  Index most_sides = 8;    // patches with more: the corners that turn least are no corners any more
  Real straight = 45;      // degrees: nodes where the border turns less are no corners, if three others remain
  Real guard = 0.02;       // diagonals a patch may move away from its triangulation; beyond, it is cut in two along a
                           // chord of that, and each part is a transfinite patch of its own
  Real step = 1;           // sample steps between the inner points
  Index most_inner = 800;  // inner points per patch, about
};

// C0 transfinite n-sided patches from the curves alone (Salvi 2020; n = 4: Coons 1967). Patches that are no discs stay
// as they are triangulated.
Reconstruction reconstruct_transfinite(const Work& work, const SampledLayout& layout,
                                       const PatchTriangulations& triangulated, const TransfiniteOptions& options);

struct FillOptions {
  int flat_rounds = 1;  // see PlateOptions
  int bent_rounds = 1;
  Real guard = 0.25;       // patch diagonals a fill may move away from its triangulation; else it falls back to it
  Real step = 1;           // sample steps between the inner points
  Index most_inner = 800;  // inner points per patch, about
  bool use_normals = true;
};

// Thin-plate fill with the input's normals along the arcs: the triangulation is refined (Liepa 2003), then the squared
// Laplacian, less the curvature of the border, is minimised; points beyond the border carry the tangents.
Reconstruction reconstruct_filled(const Work& work, const SampledLayout& layout,
                                  const PatchTriangulations& triangulated, const FillOptions& options);

}  // namespace intarsia::kernels
