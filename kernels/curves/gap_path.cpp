#include "kernels/curves/gap_path.h"

#include <algorithm>
#include <tuple>

namespace intarsia::kernels {

namespace {

std::vector<Index> faces_of(const MeshView& mesh, const SurfacePoint& p) {
  switch (p.kind) {
    case PointKind::vertex: {
      const auto row = mesh.vertex_faces.row(p.element);
      return {row.begin(), row.end()};
    }
    case PointKind::edge:
      if (mesh.edge_f1[p.element] == kNone) return {mesh.edge_f0[p.element]};
      return {mesh.edge_f0[p.element], mesh.edge_f1[p.element]};
    case PointKind::face:
      return {p.element};
  }
  return {};
}

// Corners that a straight line inside a face joins to p without crossing a curve: not the corner behind two used edges.
std::vector<Index> corners_seen_from(const MeshView& mesh, const SurfacePoint& p,
                                     std::span<const std::uint8_t> used_vertex,
                                     std::span<const std::uint8_t> used_edge) {
  std::vector<Index> seen;
  for (Index f : faces_of(mesh, p))
    for (int i = 0; i < 3; ++i) {
      const Index v = mesh.corner[3 * f + i], e1 = mesh.face_edge[3 * f + (i + 1) % 3],
                  e2 = mesh.face_edge[3 * f + (i + 2) % 3];
      if (used_vertex[v] || (p.kind == PointKind::vertex && v == p.element)) continue;
      const auto crossed = [&](Index e) { return used_edge[e] && !(p.kind == PointKind::edge && e == p.element); };
      const bool direct = p.kind == PointKind::vertex && (mesh.corner[3 * f + (i + 1) % 3] == p.element ||
                                                          mesh.corner[3 * f + (i + 2) % 3] == p.element);
      if (direct) {
        const Index along = mesh.corner[3 * f + (i + 1) % 3] == p.element ? e2 : e1;
        if (!used_edge[along]) seen.push_back(v);
      } else if (!(crossed(e1) && crossed(e2))) {
        seen.push_back(v);
      }
    }
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  return seen;
}

struct Reached {
  Index vertex;
  Index from;  // position in the list, or kNone
  Real way;
  bool done;
};

}  // namespace

bool gap_path(const MeshView& mesh, std::span<const std::uint8_t> used_vertex, std::span<const std::uint8_t> used_edge,
              const SurfacePoint& p, const SurfacePoint& q, Real max_length, std::vector<Index>& vertices) {
  vertices.clear();
  const auto faces_p = faces_of(mesh, p), faces_q = faces_of(mesh, q);
  for (Index f : faces_p)
    if (std::find(faces_q.begin(), faces_q.end(), f) != faces_q.end()) return true;

  const Vec3 from = position(mesh, p), to = position(mesh, q);
  const auto goals = corners_seen_from(mesh, q, used_vertex, used_edge);
  // A few dozen vertices at most: a list searched from end to end is the fastest map there is.
  std::vector<Reached> list;
  const auto relax = [&](Index v, Index parent, Real way) {
    if (way + (to - mesh.point(v)).norm() > max_length) return;
    for (Reached& r : list)
      if (r.vertex == v) {
        if (!r.done && way < r.way) r.way = way, r.from = parent;
        return;
      }
    list.push_back({v, parent, way, false});
  };
  for (Index v : corners_seen_from(mesh, p, used_vertex, used_edge)) relax(v, kNone, (mesh.point(v) - from).norm());
  Index best_goal = kNone;
  Real best = max_length;
  for (;;) {
    Index next = kNone;
    for (Index i = 0; i < list.size(); ++i)
      if (!list[i].done &&
          (next == kNone || std::tie(list[i].way, list[i].vertex) < std::tie(list[next].way, list[next].vertex)))
        next = i;
    if (next == kNone || list[next].way >= best) break;
    list[next].done = true;
    const Index v = list[next].vertex;
    const Real way = list[next].way;
    if (std::binary_search(goals.begin(), goals.end(), v)) {
      const Real total = way + (to - mesh.point(v)).norm();
      if (total < best) best = total, best_goal = next;
    }
    for (Index w : mesh.vertex_vertices.row(v)) {
      if (used_vertex[w]) continue;
      const Index e = mesh.edge_between(v, w);
      if (e == kNone || used_edge[e]) continue;
      relax(w, next, way + (mesh.point(w) - mesh.point(v)).norm());
    }
  }
  for (Index i = best_goal; i != kNone; i = list[i].from) vertices.push_back(list[i].vertex);
  std::reverse(vertices.begin(), vertices.end());
  return best_goal != kNone;
}

}  // namespace intarsia::kernels
