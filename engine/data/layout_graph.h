// The layout as a graph on a refined mesh: nodes joined by arcs, patches bounded by loops of arcs.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/data/csr.h"
#include "engine/data/curve_network.h"

namespace intarsia {

// A half-arc is 2 * arc (from start to end) or 2 * arc + 1 (back); the patch it bounds lies on its left.
struct LayoutGraph {
  std::vector<Index> node;               // node -> refined vertex, ascending
  std::vector<std::uint8_t> artificial;  // per node: 1 if it only marks the start of a loop that has no other node
  Csr arc;        // arc -> refined vertices in order, both end nodes included; a closed arc repeats its first
  Csr arc_edges;  // arc -> refined edges in order, one fewer than vertices
  std::vector<Index> start, end;   // per arc: node ids
  std::vector<CurveKind> kind;     // per arc: the kind with the greatest length
  std::vector<Real> strength;      // per arc: mean turn angle along it, radians
  std::vector<Index> left, right;  // per arc: patch on either side seen along the arc; kNone outside the surface
  std::vector<Real> length;        // per arc
  Csr loop;                        // loop -> half-arcs in cyclic order, patch on the left
  std::vector<Index> loop_patch;   // ascending
  Csr patch_loops;                 // patch -> loops, ascending; empty row: a patch without border

  Index node_count() const { return static_cast<Index>(node.size()); }
  Index arc_count() const { return static_cast<Index>(kind.size()); }
  Index loop_count() const { return static_cast<Index>(loop_patch.size()); }
  Index patch_count() const { return patch_loops.rows(); }
  bool is_closed(Index a) const { return start[a] == end[a]; }
  Index patch_of_half_arc(Index h) const { return h % 2 ? right[h / 2] : left[h / 2]; }
};

}  // namespace intarsia
