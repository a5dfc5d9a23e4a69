// Rebuilding a surface from the curve network of a layout alone (sections 12 and 13): what a layout is judged by.
// Three ways: optimal triangulations of the loops, transfinite patches, and thin-plate fills that also take the input's
// normals along the arcs.
#pragma once

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
  Index bridged_count() const;
  Index failed_count() const;
};

// Optimal triangulations of the loops of every patch (Zou, Ju, Carr 2013).
Reconstruction reconstruct_triangulated(const Work& work, const SampledLayout& layout, const LoopsOptions& options);

struct TransfiniteOptions {
  Index most_sides = 8;    // patches with more: the corners that turn least are no corners any more
  Real long_side = 3;      // medians: sides longer than this are cut at their middle
  Real step = 2;           // sample steps between the inner points
  Index most_inner = 800;  // inner points per patch, about
  LoopsOptions start;      // for patches that are no discs, which are triangulated
};

// C0 transfinite n-sided patches from the curves alone (Salvi 2020; n = 4: Coons 1967).
Reconstruction reconstruct_transfinite(const Work& work, const SampledLayout& layout,
                                       const TransfiniteOptions& options);

struct FillOptions {
  LoopsOptions start;      // the triangulation to start from
  int rounds = 3;          // solves: the first with uniform weights, the others with those of the last shape
  Real guard = 0.25;       // patch diagonals a fill may move away from its triangulation
  Real step = 2;           // sample steps between the inner points
  Index most_inner = 800;  // inner points per patch, about
  bool use_normals = true;
};

// Thin-plate fill with the input's normals along the arcs: the triangulation is refined (Liepa 2003), then the squared
// cotangent Laplacian is minimised, with a row of fixed points beyond the border that carries the tangents.
Reconstruction reconstruct_filled(const Work& work, const SampledLayout& layout, const FillOptions& options);

}  // namespace intarsia::kernels
