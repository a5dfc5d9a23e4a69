// Embedding of curves in a mesh: triangles are cut so that every curve becomes a chain of mesh edges at its true place
// (Cao, Yan, Wonka 2014 leave this open; split mode in the sense of snapping only what would make slivers).
#pragma once

#include <vector>

#include "engine/data/curve_network.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct Embedding {
  RefinedMesh refined;
  std::vector<Index> point_vertex;  // network point -> refined vertex
  // Every sub-segment of a curve: the refined edge it became, and the curve. Sorted by (edge, curve), no duplicates.
  std::vector<Index> edge, edge_curve;
};

// Any number of points on an edge or inside a face; segments may cross (the crossing becomes a vertex) or coincide.
// Requires: consecutive points of a curve share a face of `mesh`.
// Ensures: every curve segment is a chain of refined edges; refined faces keep the order and orientation of their
// parents; points closer than 1e-6 of an edge to a vertex (or to each other) are merged with it. on_network is 1 on
// boundary edges (kind border) and on edges of curves; where curves coincide the smaller kind and the larger strength
// win.
// Errors: internal (element = curve) if two consecutive points share no face.
Embedding embed_curves(const Work& work, const MeshView& mesh, const CurveNetwork& curves);

}  // namespace intarsia::kernels
