// Smooths the arcs of a layout by sliding their points on the original surface (Eq. 8 with a length term).
// The mesh itself does not change: cross_edges turns the result into curves that can be embedded again.
#pragma once

#include <span>

#include "engine/data/layout_graph.h"
#include "engine/parallel/work.h"
#include "kernels/layout/principal_lines.h"

namespace intarsia::kernels {

struct SmoothOptions {
  Real length_weight = 0.25;      // lambda: weight of the length against the alignment with a principal direction
  bool nearest_direction = true;  // per arc the nearer of t_min and t_max; false: always t_min (the paper)
  int iterations = 20;            // Jacobi steps
  Real damping = 0.5;             // share of each step that is taken
  Real free_reach = 1;            // mean edges: how far a point of a free arc may get from its start
  Real feature_reach = 0.3;       // mean edges: the same for ridges and valleys
  Real width_reach = 0.45;        // share of the width (2 area / perimeter) of the narrower patch: same limit
};

// Positions on the original mesh. Inner points of arc a: offset[a] .. offset[a + 1] - 1, in the arc's order, one for
// each refined vertex between the arc's end nodes.
struct SmoothedArcs {
  std::vector<SurfacePoint> node;
  std::vector<std::uint8_t> node_fixed;
  std::vector<Index> offset;
  std::vector<SurfacePoint> point;
  std::vector<std::uint8_t> fixed;
};

// Fixed: points on the mesh boundary, on sharp edges and on other creases of 60 degrees and more, nodes where a feature
// or border arc ends, everything whose reach is zero. Their positions are RefinedMesh::origin, unchanged. All others
// come as points strictly inside a face. The mean edge of a point is that of the faces around its start, smoothed along
// the arc, at most twice the mesh's mean. Requires: label per refined face, the one `graph` was traced from; lines per
// original vertex (empty: length only); refined is a refinement of `original`. Ensures: |moved - start| <= reach of the
// point (and 1/1000 of its face, the distance kept from the edges); closed arcs that lost half of their length are put
// back. Source: Cao, Yan, Wonka 2014, Eq. 8, as a quadratic form M = I + conf / lambda (J X)(J X)^T per segment.
SmoothedArcs smooth_boundaries(const Work& work, MeshView original, const RefinedMesh& refined,
                               const LayoutGraph& graph, std::span<const Index> label, const PrincipalLines& lines,
                               const SmoothOptions& options = {});

}  // namespace intarsia::kernels
