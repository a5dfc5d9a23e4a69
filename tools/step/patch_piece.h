// One patch of a layout as a mesh of its own, cut open along the layout's arcs.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/data/csr.h"
#include "engine/data/layout_graph.h"

namespace intarsia::tools {

struct PatchPiece {
  std::vector<Vec3> point;
  std::vector<std::array<Index, 3>> triangle;
  std::vector<Index> face;    // triangle -> face of the layout's mesh
  std::vector<Index> vertex;  // point -> vertex of the layout's mesh; a patch that touches itself has some twice

  struct Side {
    Index half_arc = 0;
    Index begin = 0;  // first point of the side in its loop
  };
  struct Loop {
    std::vector<Index> point;  // the patch on the left, the first not repeated
    std::vector<Side> side;
    Real length = 0;
  };
  std::vector<Loop> loop;  // the longest first

  int euler = 0;  // vertices - edges + triangles
  // A disc with any number of holes.
  bool is_flat_in_kind() const { return !loop.empty() && euler == 2 - static_cast<int>(loop.size()); }

  // The points of a side in order, both ends included.
  std::vector<Index> side_points(const Loop& l, std::size_t s) const;
};

// What all patches of a layout share.
class PatchPieces {
 public:
  // mesh, label, graph: must outlive this.
  PatchPieces(const MeshView& mesh, std::span<const Index> label, const LayoutGraph& graph);
  Index count() const { return faces_.rows(); }
  Index faces_of(Index patch) const { return static_cast<Index>(faces_.row(patch).size()); }
  PatchPiece piece(Index patch) const;

 private:
  MeshView mesh_;
  std::span<const Index> label_;
  const LayoutGraph& graph_;
  Csr faces_;
  std::vector<Index> place_;             // face -> position in its patch
  std::vector<std::uint8_t> is_border_;  // per edge: carries an arc
};

}  // namespace intarsia::tools
