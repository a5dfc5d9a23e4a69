// Triangles sorted into a tree of boxes with up to eight children a node and eight triangles a leaf.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "engine/space/triangle_tree.h"

namespace intarsia {

struct Box {
  std::array<Real, 3> low, high;

  Box() {
    low.fill(std::numeric_limits<Real>::infinity());
    high.fill(-std::numeric_limits<Real>::infinity());
  }
  void add(const Box& o) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = o.low[k] < low[k] ? o.low[k] : low[k];
      high[k] = o.high[k] > high[k] ? o.high[k] : high[k];
    }
  }
  // Half the surface; 0 if empty.
  Real half_area() const {
    const Real x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x >= 0 ? x * (y + z) + y * z : 0;
  }
};

struct SplitTriangles {
  struct Range {
    Index begin = 0, end = 0;  // of order
  };
  // A child of a node. Boxes hold everything that closest_on_triangle can return for their triangles, rounding
  // included.
  struct Part {
    Box box;
    Index child = kNone;  // node or leaf
    bool is_leaf = false;
  };
  struct Node {
    Index first = 0, count = 0;  // of part
  };

  std::vector<Index> order;  // triangles
  std::vector<Range> leaf;   // 1 to 8 triangles
  std::vector<Part> part;
  std::vector<Node> node;  // the root first, then level by level
};

// Binned surface area heuristic (Wald 2007) on the longest axis of the centres, the part of largest surface split next.
// Requires: at least one triangle, finite points.
// Ensures: the same tree for any number of threads; at most 40 levels.
SplitTriangles split_triangles(const Work& work, const TrianglesView& triangles);

}  // namespace intarsia
