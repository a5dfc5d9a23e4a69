// What the tests of the baseline segmentations share.
#pragma once

#include "engine/parallel/connect_mesh.h"
#include "kernels/baselines/face_graph.h"
#include "kernels/surface/normals.h"
#include "tests/support/raw_mesh.h"

namespace intarsia::test {

inline kernels::FaceGraph face_graph(const Soup& soup) {
  const Mesh mesh = raw_mesh(soup);
  return kernels::make_face_graph(Work(), mesh, kernels::face_geometry(Work(), mesh).normal);
}

// Every region 0 .. count - 1 is there and in one piece.
inline bool pieces_equal_regions(const kernels::FaceGraph& graph, std::span<const Index> region, Index count) {
  std::vector<std::uint8_t> seen(count, 0);
  for (const Index r : region) {
    if (r >= count) return false;
    seen[r] = 1;
  }
  for (const std::uint8_t s : seen)
    if (!s) return false;
  return kernels::connected_pieces(graph, region).count == count;
}

// Two pieces that do not touch; the second moved by 10 along x.
inline Soup side_by_side(Soup a, const Soup& b) {
  const Index n = a.vertex_count();
  for (Index v = 0; v < b.vertex_count(); ++v) a.x.push_back(b.x[v] + 10), a.y.push_back(b.y[v]), a.z.push_back(b.z[v]);
  for (const Index c : b.corner) a.corner.push_back(c + n);
  return a;
}

}  // namespace intarsia::test
