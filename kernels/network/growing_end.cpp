#include "kernels/network/growing_end.h"

#include <algorithm>

#include "engine/parallel/compact.h"

namespace intarsia::kernels {
namespace {

// Number of active edges at v, and the last of them that is not `skip`.
struct ActiveEdges {
  Index count = 0, edge = kNone;
};

ActiveEdges active_edges(const MeshView& mesh, std::span<const std::uint8_t> active, Index v, Index skip) {
  ActiveEdges found;
  for (Index f : mesh.vertex_faces.row(v))
    for (int i = 0; i < 3; ++i) {
      const Index e = mesh.face_edge[3 * f + i];
      if (!active[e] || (mesh.edge_v0[e] != v && mesh.edge_v1[e] != v)) continue;
      if (mesh.edge_f0[e] != f) continue;  // interior edges are seen from two faces: count them once
      ++found.count;
      if (e != skip) found.edge = e;
    }
  return found;
}

}  // namespace

std::vector<GrowingEnd> find_ends(const Work& work, const RefinedMesh& refined, std::span<const std::uint8_t> active,
                                  Real history) {
  const MeshView mesh = refined.mesh;
  std::vector<std::uint8_t> degree(mesh.vertex_count(), 0);
  for (Index e : compact(work, mesh.edge_count(), [&](std::size_t i) { return active[i] != 0; })) {
    for (Index v : {mesh.edge_v0[e], mesh.edge_v1[e]})
      degree[v] = static_cast<std::uint8_t>(std::min(3, degree[v] + 1));
  }
  const std::vector<Index> tips = compact(work, degree.size(), [&](std::size_t v) { return degree[v] == 1; });
  std::vector<GrowingEnd> ends(tips.size());
  for_each(work, Cost::heavy, tips.size(), [&](std::size_t i) {
    GrowingEnd& end = ends[i];
    Index v = tips[i], edge = kNone;
    Real length = 0;
    end.path.push_back(v);
    while (length < history) {
      const ActiveEdges at = active_edges(mesh, active, v, edge);
      if (at.edge == kNone || (v != tips[i] && at.count != 2)) break;
      if (edge == kNone) end.channel = refined.edge_kind[at.edge];
      edge = at.edge;
      const Index w = mesh.other_vertex(edge, v);
      if (w == tips[i]) break;
      length += (mesh.point(w) - mesh.point(v)).norm();
      v = w;
      end.path.push_back(v);
    }
    std::reverse(end.path.begin(), end.path.end());
    end.start = end.path.size() - 1;
    end.tracer = mesh.point(tips[i]);
  });
  return ends;
}

}  // namespace intarsia::kernels
