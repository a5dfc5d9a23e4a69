// Vertex normals good enough to shade with, for callers that have none.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/parallel/work.h"
#include "tools/picture/shape.h"

namespace intarsia::tools {

// Above this, a triangle is smaller than a pixel and its own normal does.
inline constexpr std::size_t kLargestSmoothed = 1'500'000;  // vertices

struct ShadingNormals {
  std::vector<std::array<std::int32_t, 3>> sum;  // not normalised; empty: shade flat

  bool empty() const { return sum.empty(); }
  Vec3 operator[](std::size_t v) const {
    return {static_cast<Real>(sum[v][0]), static_cast<Real>(sum[v][1]), static_cast<Real>(sum[v][2])};
  }
};

// Sums of face normals around each vertex, in fixed point: integer sums do not depend on their order, so faces scatter
// in parallel without adjacency. Weight of a corner: (1 - cos angle) / 2, which grows with the angle.
// Empty if shape brings its own normals, is not smooth or has more than kLargestSmoothed vertices.
ShadingNormals shading_normals(const Work& work, const Shape& shape);

}  // namespace intarsia::tools
