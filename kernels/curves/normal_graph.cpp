#include "kernels/curves/normal_graph.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/parallel/build_csr.h"
#include "engine/parallel/compact.h"
#include "engine/parallel/union_find.h"

namespace intarsia::kernels {

namespace {

Vec3 area_normal_at(const MeshView& mesh, Index v) {
  Vec3 sum = Vec3::Zero();
  for (Index f : mesh.vertex_faces.row(v)) {
    const auto [i, j, k] = mesh.face(f);
    sum += (mesh.point(j) - mesh.point(i)).cross(mesh.point(k) - mesh.point(i));
  }
  return sum / 6;
}

}  // namespace

NormalGraph normal_graph(const Work& work, const MeshView& mesh, std::span<const std::uint8_t> barrier, Real spacing) {
  NormalGraph graph;
  const Index n = mesh.vertex_count();
  Vec3Array normal(n);
  for_each(work, Cost::medium, n, [&](std::size_t v) { normal.set(v, area_normal_at(mesh, static_cast<Index>(v))); });
  if (!(spacing > 0)) {
    graph.point = Vec3Array(n);
    for_each(work, Cost::light, n, [&](std::size_t v) { graph.point.set(v, mesh.point(static_cast<Index>(v))); });
    graph.normal = std::move(normal);
    return graph;
  }
  const auto cube = [&](Index v) {
    return std::array<Real, 3>{std::floor(mesh.x[v] / spacing), std::floor(mesh.y[v] / spacing),
                               std::floor(mesh.z[v] / spacing)};
  };
  UnionFind sets(n);
  for_each(work, Cost::light, mesh.edge_count(), [&](std::size_t e) {
    const Index a = mesh.edge_v0[e], b = mesh.edge_v1[e];
    if (!barrier.empty() && (barrier[a] || barrier[b])) return;
    if (cube(a) == cube(b)) sets.unite(a, b);
  });
  std::vector<Index> root(n);
  for_each(work, Cost::light, n, [&](std::size_t v) { root[v] = sets.find(static_cast<Index>(v)); });
  const auto roots = compact(work, n, [&](std::size_t v) { return root[v] == v; });
  graph.node_of.resize(n);
  for_each(work, Cost::light, roots.size(), [&](std::size_t i) { graph.node_of[roots[i]] = static_cast<Index>(i); });
  for_each(work, Cost::light, n, [&](std::size_t v) {
    if (root[v] != v) graph.node_of[v] = graph.node_of[root[v]];
  });
  const Index nodes = static_cast<Index>(roots.size());
  const Csr members = build_csr(
      work, nodes, n, [&](std::size_t v) { return graph.node_of[v]; },
      [](std::size_t v) { return static_cast<Index>(v); });
  graph.point = Vec3Array(nodes), graph.normal = Vec3Array(nodes);
  for_each(work, Cost::medium, nodes, [&](std::size_t i) {
    Vec3 p = Vec3::Zero(), m = Vec3::Zero();
    for (Index v : members.row(static_cast<Index>(i))) p += mesh.point(v), m += normal[v];
    graph.point.set(i, p / static_cast<Real>(members.row(static_cast<Index>(i)).size()));
    graph.normal.set(i, m);
  });
  // Neighbours may repeat: the walk that uses them does not mind.
  graph.neighbours = build_csr(
      work, nodes, 2 * std::size_t{mesh.edge_count()},
      [&](std::size_t i) {
        const Index a = graph.node_of[mesh.edge_v0[i / 2]], b = graph.node_of[mesh.edge_v1[i / 2]];
        return a == b ? kNone : (i % 2 ? b : a);
      },
      [&](std::size_t i) { return graph.node_of[i % 2 ? mesh.edge_v0[i / 2] : mesh.edge_v1[i / 2]]; });
  return graph;
}

}  // namespace intarsia::kernels
