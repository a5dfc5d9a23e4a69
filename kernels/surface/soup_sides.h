// The sides of triangles, sorted so that the triangles along an edge stand together.
#pragma once

#include <compare>
#include <span>
#include <vector>

#include "engine/base/types.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Side i of triangle t runs from its corner i to corner i + 1.
struct Side {
  Index a = 0, b = 0;    // vertices of the edge, a < b
  Index at = 0;          // 3 t + i
  bool forward = false;  // the triangle runs from a to b
  auto operator<=>(const Side&) const = default;

  Index triangle() const { return at / 3; }
  bool same_edge(const Side& o) const { return a == o.a && b == o.b; }
};

// Sides of all triangles by (a, b, at). Requires: no triangle has a corner twice.
std::vector<Side> sorted_sides(const Work& work, std::span<const Index> corner);

// visit(begin, end) for every edge: its sides are side[begin, end). Serial, in order.
template <class Visit>
void for_each_edge(const Work& work, const std::vector<Side>& side, const Visit& visit) {
  for (std::size_t i = 0, edges = 0; i < side.size(); ++edges) {
    std::size_t end = i + 1;
    while (end < side.size() && side[end].same_edge(side[i])) ++end;
    visit(i, end);
    if ((edges & 0xfff) == 0) work.check();
    i = end;
  }
}

}  // namespace intarsia::kernels
