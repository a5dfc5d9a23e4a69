// The arcs of a layout as polylines of even steps, sampled once and shared by the patches on both sides: what is
// rebuilt from them is watertight.
#pragma once

#include <span>
#include <vector>

#include "engine/data/layout_graph.h"
#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct SampleOptions {
  Index loop_samples = 200;  // the loops of a patch together have at most about so many points
  Index least_closed = 8;    // segments of an arc that is a loop of its own; at least 3
  int normal_passes = 3;     // of averaging the side normals along their arc
};

struct SampledLayout {
  Vec3Array point;      // nodes first (one per node of the graph), then the inner points of the arcs, arc by arc
  Vec3Array normal[2];  // per point: unit normals of the input just left and right of the arc, 0 where none
                        // (used by the energy fill alone); at nodes: zero
  Csr arc;              // arc -> points in order, both ends included
  Csr loop;             // loop -> half-arcs (as LayoutGraph)
  std::vector<Index> loop_patch;
  Csr patch_loops;
  Index nodes = 0;

  Index patch_count() const { return patch_loops.rows(); }
};

// mesh: the refined mesh the graph lies on; label: patch per face of it.
// The step of an arc is the larger of its two patches' border lengths / loop_samples. Nodes are kept; arcs that share
// both ends get at least two segments, so that no two arcs fall together.
// Normals: mean of the faces in the second ring on the side of the patch. Those that touch the curve may lie astride it
// and have the neighbour's normal; they serve only where there are no others.
SampledLayout sample_layout(const Work& work, const MeshView& mesh, const LayoutGraph& graph,
                            std::span<const Index> label, const SampleOptions& options);

// Points of one loop of a sampled layout, in the order with the patch on the left, and where its half-arcs begin.
struct LoopPoints {
  std::vector<Index> point, side;  // side: positions in point; one more than half-arcs
};
void append_loop(const SampledLayout& layout, Index loop, LoopPoints& out);

}  // namespace intarsia::kernels
