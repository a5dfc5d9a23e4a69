#include "kernels/baselines/face_graph.h"

#include <algorithm>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {

FaceGraph make_face_graph(const Work& work, const MeshView& mesh, Vec3View normal) {
  FaceGraph g;
  const Index n = mesh.face_count();
  g.area.resize(n), g.normal.resize(n), g.centroid.resize(n), g.neighbour.resize(3 * std::size_t{n});
  for_each(work, Cost::light, n, [&](std::size_t i) {
    const Index f = static_cast<Index>(i);
    const auto [a, b, c] = mesh.face(f);
    const Vec3 p = mesh.point(a), u = mesh.point(b) - p, v = mesh.point(c) - p;
    g.normal[f] = normal[f];
    g.area[f] = normal[f].isZero() ? 0 : u.cross(v).norm() / 2;
    g.centroid[f] = p + (u + v) / 3;
    for (Index k = 0; k < 3; ++k) g.neighbour[3 * f + k] = mesh.other_face(mesh.face_edge[3 * f + k], f);
  });
  return g;
}

FaceGraph subgraph(const FaceGraph& graph, std::span<const Index> faces) {
  std::vector<Index> rank(graph.faces(), kNone);
  for (Index i = 0; i < faces.size(); ++i) rank[faces[i]] = i;
  FaceGraph g;
  g.neighbour.reserve(3 * faces.size());
  for (const Index f : faces) {
    g.area.push_back(graph.area[f]);
    g.normal.push_back(graph.normal[f]);
    g.centroid.push_back(graph.centroid[f]);
    for (const Index o : graph.around(f)) g.neighbour.push_back(o == kNone ? kNone : rank[o]);
  }
  return g;
}

PatchLabels connected_pieces(const FaceGraph& graph, std::span<const Index> id) {
  PatchLabels pieces;
  pieces.patch_of_face.assign(graph.faces(), kNone);
  std::vector<Index> stack;
  for (Index start = 0; start < graph.faces(); ++start) {
    if (pieces.patch_of_face[start] != kNone) continue;
    pieces.patch_of_face[start] = pieces.count;
    stack.push_back(start);
    while (!stack.empty()) {
      const Index f = stack.back();
      stack.pop_back();
      for (const Index o : graph.around(f)) {
        if (o == kNone || pieces.patch_of_face[o] != kNone) continue;
        if (!id.empty() && id[o] != id[f]) continue;
        pieces.patch_of_face[o] = pieces.count;
        stack.push_back(o);
      }
    }
    ++pieces.count;
  }
  return pieces;
}

PatchLabels connected_pieces(const FaceGraph& graph) { return connected_pieces(graph, {}); }

std::vector<std::array<Index, 2>> adjacent_regions(const FaceGraph& graph, std::span<const Index> region) {
  std::vector<std::array<Index, 2>> pairs;
  for (Index f = 0; f < graph.faces(); ++f)
    for (const Index o : graph.around(f))
      if (o != kNone && region[f] < region[o]) {
        const std::array<Index, 2> pair{region[f], region[o]};
        if (pairs.empty() || pairs.back() != pair) pairs.push_back(pair);
      }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace intarsia::kernels
