// Rebuilding a surface from the curve network of a layout alone (sections 12 and 13): what a layout is judged by.
#pragma once

#include <vector>

#include "engine/data/layout_graph.h"
#include "engine/data/mesh.h"
#include "engine/parallel/work.h"
#include "engine/space/triangulate_loops.h"

namespace intarsia::kernels {

struct SampleOptions {
  Index loop_samples = 200;  // a loop has at most about so many points
  Index least_closed = 8;    // points of an arc that is a loop of its own
};

// The arcs of a layout as polylines of even steps, sampled once and shared by both sides: what is rebuilt from them is
// watertight.
struct SampledLayout {
  Vec3Array point;      // nodes first (one per node of the graph), then the inner points of the arcs
  Vec3Array normal[2];  // per point: unit normals of the input just left and right of the arc, 0 where none
                        // (used by the energy fill alone); at nodes: zero
  Csr arc;              // arc -> points in order, both ends included
  Csr loop;             // loop -> half-arcs (as LayoutGraph)
  std::vector<Index> loop_patch;
  Csr patch_loops;
};

// mesh: the refined mesh the graph lies on; label: patch per face of it.
SampledLayout sample_layout(const Work& work, const MeshView& mesh, const LayoutGraph& graph,
                            std::span<const Index> label, const SampleOptions& options);

// One watertight triangle surface; patch per triangle. Points shared along arcs.
struct Reconstruction {
  Vec3Array point;  // those of the samples first
  std::vector<Index> corner, patch;
  Index bridged = 0;  // patches with several loops
  Index failed = 0;   // patches that could not be filled and were left out, or fell back to the triangulation
};

Reconstruction reconstruct_triangulated(const Work& work, const SampledLayout& layout, const LoopsOptions& options);

struct TransfiniteOptions {
  Index most_sides = 8;
};
// C0 transfinite n-sided patches from the curves alone (Salvi 2020). Patches that are no discs: as triangulated.
Reconstruction reconstruct_transfinite(const Work& work, const SampledLayout& layout,
                                       const TransfiniteOptions& options);

struct FillOptions {
  LoopsOptions start;
  int rounds = 3;     // solves: the first with uniform weights, the others with those of the last shape
  Real guard = 0.25;  // patch diagonals a fill may move away from its triangulation; beyond, it falls back to it
};
// Thin-plate fill with the input's normals along the arcs.
Reconstruction reconstruct_filled(const Work& work, const SampledLayout& layout, const FillOptions& options);

}  // namespace intarsia::kernels
