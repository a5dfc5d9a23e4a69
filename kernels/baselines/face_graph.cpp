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
  if (!graph.offset.empty()) g.offset.push_back(0);
  for (const Index f : faces) {
    g.area.push_back(graph.area[f]);
    g.normal.push_back(graph.normal[f]);
    g.centroid.push_back(graph.centroid[f]);
    for (const Index o : graph.around(f)) g.neighbour.push_back(o == kNone ? kNone : rank[o]);
    if (!graph.offset.empty()) g.offset.push_back(static_cast<Index>(g.neighbour.size()));
  }
  return g;
}

BallGraph gather_balls(const Work& work, const FaceGraph& graph, Index size) {
  constexpr Real kTurn = 0.8;  // cosine
  BallGraph balls;
  FaceGraph& g = balls.graph;
  balls.ball.assign(graph.faces(), kNone);
  std::vector<Index> faces;
  for (Index start = 0; start < graph.faces(); ++start) {
    if (start % 4096 == 0) work.check();
    if (balls.ball[start] != kNone) continue;
    const Index id = g.faces();
    faces.assign(1, start), balls.ball[start] = id;
    for (std::size_t i = 0; i < faces.size() && faces.size() < size; ++i)
      for (const Index o : graph.around(faces[i])) {
        if (o == kNone || balls.ball[o] != kNone || faces.size() >= size) continue;
        if (graph.area[o] > 0 && graph.normal[o].dot(graph.normal[start]) < kTurn) continue;
        balls.ball[o] = id;
        faces.push_back(o);
      }
    Real area = 0;
    Vec3 sum = Vec3::Zero(), middle = Vec3::Zero();
    for (const Index f : faces)
      area += graph.area[f], sum += graph.area[f] * graph.normal[f], middle += graph.area[f] * graph.centroid[f];
    g.area.push_back(area);
    g.normal.push_back(area > 0 ? Vec3(sum / area) : Vec3::Zero());
    g.centroid.push_back(area > 0 ? Vec3(middle / area) : graph.centroid[start]);
  }
  std::vector<std::array<Index, 2>> links;
  for (Index f = 0; f < graph.faces(); ++f)
    for (const Index o : graph.around(f))
      if (o != kNone && balls.ball[f] != balls.ball[o]) links.push_back({balls.ball[f], balls.ball[o]});
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  g.offset.assign(std::size_t{g.faces()} + 1, 0);
  for (const auto& [a, b] : links) ++g.offset[a + 1], g.neighbour.push_back(b);
  for (Index i = 0; i < g.faces(); ++i) g.offset[i + 1] += g.offset[i];
  return balls;
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
