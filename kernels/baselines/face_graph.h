// The faces of a surface, or of a part of it, as a graph: what the baseline segmentations run on.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/data/patch_labels.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct FaceGraph {
  std::vector<Real> area;    // 0 for a face without a normal
  std::vector<Vec3> normal;  // unit, 0 for a degenerate face; of a ball of faces the mean, at most 1 long
  std::vector<Vec3> centroid;
  std::vector<Index> neighbour;  // 3 per face, across the edge opposite corner i; kNone at a border
  std::vector<Index> offset;     // of balls: where their neighbours begin; empty for faces

  Index faces() const { return static_cast<Index>(area.size()); }
  std::span<const Index> around(Index f) const {
    const std::span<const Index> all(neighbour);
    return offset.empty() ? all.subspan(3 * std::size_t{f}, 3) : all.subspan(offset[f], offset[f + 1] - offset[f]);
  }
};

// Requires: one unit (or zero) normal per face.
FaceGraph make_face_graph(const Work& work, const MeshView& mesh, Vec3View normal);

// The graph of some faces alone, in the order of the list; links to others are cut. Requires: a graph of faces or of
// balls.
FaceGraph subgraph(const FaceGraph& graph, std::span<const Index> faces);

// The graph of connected balls of about `size` faces, which stop where the surface turns by more than about 37 degrees.
// Energies of regions of balls are those of their faces.
struct BallGraph {
  FaceGraph graph;
  std::vector<Index> ball;  // of every face
};
BallGraph gather_balls(const Work& work, const FaceGraph& graph, Index size);

// Connected pieces of equal ids, named in order of their smallest face.
PatchLabels connected_pieces(const FaceGraph& graph, std::span<const Index> id);
// Connected pieces of the graph.
PatchLabels connected_pieces(const FaceGraph& graph);

// Pairs (smaller, larger) of regions with a common edge, ascending, each once.
std::vector<std::array<Index, 2>> adjacent_regions(const FaceGraph& graph, std::span<const Index> region);

}  // namespace intarsia::kernels
