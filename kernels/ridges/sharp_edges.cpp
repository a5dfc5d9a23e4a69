#include "kernels/ridges/sharp_edges.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/compact.h"
#include "engine/parallel/union_find.h"
#include "kernels/ridges/chain_segments.h"

namespace intarsia::kernels {

namespace {

Vec3 area_normal(const MeshView& mesh, Index f) {
  const auto [i, j, k] = mesh.face(f);
  return 0.5 * (mesh.point(j) - mesh.point(i)).cross(mesh.point(k) - mesh.point(i));
}

struct Fold {
  Real turn = 0;  // angle between the normals of the two faces
  bool concave = false;
  Vec3 normal = Vec3::Zero();  // bisector
};

Fold fold_at(const MeshView& mesh, Index e) {
  Fold fold;
  if (mesh.is_boundary_edge(e)) return fold;
  Vec3 n0 = area_normal(mesh, mesh.edge_f0[e]), n1 = area_normal(mesh, mesh.edge_f1[e]);
  const Real a0 = n0.norm(), a1 = n1.norm();
  const Real side = (mesh.point(mesh.edge_v1[e]) - mesh.point(mesh.edge_v0[e])).squaredNorm();
  if (!(std::min(a0, a1) > 1e-10 * side)) return fold;
  n0 /= a0, n1 /= a1;
  fold.turn = std::atan2(n0.cross(n1).norm(), n0.dot(n1));
  const auto centroid = [&](Index f) {
    const auto [i, j, k] = mesh.face(f);
    return Vec3((mesh.point(i) + mesh.point(j) + mesh.point(k)) / 3);
  };
  fold.concave = (centroid(mesh.edge_f1[e]) - centroid(mesh.edge_f0[e])).dot(n0) > 0;
  const Vec3 sum = n0 + n1;
  fold.normal = sum.norm() > 1e-9 ? Vec3(sum.normalized()) : n0;
  return fold;
}

// Median turn of the other edges of the faces around both ends: 0 beside a crease, about the noise on a rough surface.
float median_turn_around(const MeshView& mesh, std::span<const float> turn, Index e) {
  constexpr std::size_t kMost = 192;  // a few times the usual 26; poles of high valence need no more
  float around[kMost] = {};
  std::size_t n = 0;
  for (Index v : {mesh.edge_v0[e], mesh.edge_v1[e]})
    for (Index f : mesh.vertex_faces.row(v))
      for (int i = 0; i < 3 && n < kMost; ++i)
        if (mesh.face_edge[3 * f + i] != e) around[n++] = turn[mesh.face_edge[3 * f + i]];
  if (n == 0) return 0;
  std::nth_element(around, around + n / 2, around + n);
  return around[n / 2];
}

Vec3 direction(const MeshView& mesh, Index e, Index from) {
  return (mesh.point(mesh.other_vertex(e, from)) - mesh.point(from)).normalized();
}

Index edge_to(const MeshView& mesh, Index from, Index to) { return mesh.edge_between(from, to); }

// From every end of a strong chain along the straightest weak edge of the same kind, until a sharp edge is met.
void continue_chains(const Work& work, const MeshView& mesh, const std::vector<Fold>& fold,
                     std::span<const Index> candidate, const SharpOptions& options, std::vector<std::uint8_t>& sharp,
                     std::vector<Index>& slot_of_edge) {
  // sharp[i] belongs to candidate[i]; slot_of_edge maps an edge to i.
  std::vector<std::uint8_t> degree(mesh.vertex_count(), 0);
  const auto bump = [&](Index e) {
    for (Index v : {mesh.edge_v0[e], mesh.edge_v1[e]})
      degree[v] = static_cast<std::uint8_t>(std::min(degree[v] + 1, 9));
  };
  std::vector<std::pair<Index, Index>> head;  // (candidate slot, end vertex)
  for (Index i = 0; i < candidate.size(); ++i)
    if (sharp[i]) bump(candidate[i]);
  for (Index i = 0; i < candidate.size(); ++i)
    if (sharp[i])
      for (Index v : {mesh.edge_v0[candidate[i]], mesh.edge_v1[candidate[i]]})
        if (degree[v] == 1) head.push_back({i, v});
  std::size_t steps = 0;
  for (auto [slot, v] : head) {
    while (degree[v] == 1) {
      if (++steps % 4096 == 0) work.check();
      const Vec3 ahead = -direction(mesh, candidate[slot], v);
      Index next = kNone;
      Real best = std::cos(options.continuation);
      for (Index w : mesh.vertex_vertices.row(v)) {
        const Index e = edge_to(mesh, v, w);
        const Index i = e == kNone ? kNone : slot_of_edge[e];
        if (i == kNone || sharp[i] || fold[i].concave != fold[slot].concave) continue;
        const Real cosine = ahead.dot(direction(mesh, e, v));
        if (cosine > best) best = cosine, next = i;
      }
      if (next == kNone) break;
      sharp[next] = 1;
      bump(candidate[next]);
      v = mesh.other_vertex(candidate[next], v);
      slot = next;
    }
  }
}

}  // namespace

SharpEdges sharp_edges(const Work& work, const MeshView& mesh, Real edge_length, const SharpOptions& options) {
  SharpEdges out;
  out.curves.net.curve.offset.assign(1, 0);
  if (!options.enabled) return out;
  std::vector<float> turn(mesh.edge_count());
  for_each(work, Cost::light, turn.size(),
           [&](std::size_t e) { turn[e] = static_cast<float>(fold_at(mesh, static_cast<Index>(e)).turn); });
  // A hair of slack, so that a cube with rounded coordinates at exactly the limit is one thing or the other as a whole.
  const Real weak = options.weak - 1e-6, strong = options.strong - 1e-6;
  const auto candidate = compact(work, turn.size(), [&](std::size_t e) {
    return turn[e] >= weak && turn[e] >= options.relative * median_turn_around(mesh, turn, static_cast<Index>(e));
  });
  std::vector<Fold> fold(candidate.size());
  std::vector<std::uint8_t> sharp(candidate.size());
  std::vector<Index> slot_of_edge(candidate.empty() ? 0 : mesh.edge_count(), kNone);
  for_each(work, Cost::light, candidate.size(), [&](std::size_t i) {
    fold[i] = fold_at(mesh, candidate[i]);
    sharp[i] = turn[candidate[i]] >= strong;
    slot_of_edge[candidate[i]] = static_cast<Index>(i);
  });
  if (std::find(sharp.begin(), sharp.end(), 1) == sharp.end()) return out;
  continue_chains(work, mesh, fold, candidate, options, sharp, slot_of_edge);

  // Connected sets that are too small or too short are noise.
  UnionFind sets(mesh.vertex_count());
  for_each(work, Cost::light, candidate.size(), [&](std::size_t i) {
    if (sharp[i]) sets.unite(mesh.edge_v0[candidate[i]], mesh.edge_v1[candidate[i]]);
  });
  std::vector<Real> set_length(mesh.vertex_count(), 0);
  std::vector<Index> set_edges(mesh.vertex_count(), 0);
  const auto length_of = [&](Index e) { return (mesh.point(mesh.edge_v1[e]) - mesh.point(mesh.edge_v0[e])).norm(); };
  for (std::size_t i = 0; i < candidate.size(); ++i) {
    if (!sharp[i]) continue;
    const Index s = sets.find(mesh.edge_v0[candidate[i]]);
    set_length[s] += length_of(candidate[i]);
    ++set_edges[s];
  }
  const Real shortest = std::max(options.min_length, options.min_length_in_edges * edge_length);
  std::vector<Index> kept;  // candidate slots, ascending
  for (Index i = 0; i < candidate.size(); ++i) {
    if (!sharp[i]) continue;
    const Index s = sets.find(mesh.edge_v0[candidate[i]]);
    if (set_edges[s] >= options.min_edges && set_length[s] >= shortest) kept.push_back(i);
  }
  if (kept.empty()) return out;

  // Points: the vertices on sharp edges, ascending.
  std::vector<Index> point_of(mesh.vertex_count(), kNone);
  for (Index i : kept) point_of[mesh.edge_v0[candidate[i]]] = point_of[mesh.edge_v1[candidate[i]]] = 0;
  const auto vertex = compact(work, mesh.vertex_count(), [&](std::size_t v) { return point_of[v] == 0; });
  for (Index p = 0; p < vertex.size(); ++p) point_of[vertex[p]] = p;
  FeatureCurves& curves = out.curves;
  curves.resize_points(vertex.size());
  std::vector<Index> a(kept.size()), b(kept.size()), degree(vertex.size(), 0);
  std::vector<Vec3> normal(vertex.size(), Vec3::Zero()), first(vertex.size(), Vec3::Zero());
  std::vector<Real> turned(vertex.size(), 0);
  std::vector<std::uint8_t> stop(vertex.size(), 0), concave(vertex.size(), 0);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Index e = candidate[kept[i]];
    const Fold& f = fold[kept[i]];
    out.edge.push_back(e);
    a[i] = point_of[mesh.edge_v0[e]], b[i] = point_of[mesh.edge_v1[e]];
    for (Index p : {a[i], b[i]}) {
      const Vec3 away = direction(mesh, e, vertex[p]);
      if (degree[p] == 0) first[p] = away, concave[p] = f.concave;
      if (degree[p] == 1 && (concave[p] != f.concave || -first[p].dot(away) < std::cos(options.corner))) stop[p] = 1;
      ++degree[p];
      normal[p] += f.normal;
      turned[p] = std::max(turned[p], f.turn);
    }
  }
  for (Index p = 0; p < vertex.size(); ++p) {
    const Vec3 n = normal[p].norm() > 1e-9 ? Vec3(normal[p].normalized()) : Vec3(first[p].unitOrthogonal());
    const Vec3 across = n.cross(first[p]);
    curves.net.point[p] = SurfacePoint::at_vertex(vertex[p]);
    curves.normal.set(p, n);
    curves.across.set(p, across.norm() > 1e-9 ? Vec3(across.normalized()) : Vec3(n.unitOrthogonal()));
    // The crease spread over one edge: a curvature of the right order, and of the right order only.
    curves.kd[p] = turned[p] / edge_length;
    curves.kmax[p] = concave[p] ? 0 : curves.kd[p];
    curves.kmin[p] = concave[p] ? -curves.kd[p] : 0;
    curves.extremality[p] = 0;
    curves.sharpness[p] = 1;
    curves.radius[p] = edge_length;
    curves.turn()[p] = turned[p];
  }
  const Csr chains = chain_segments(work, static_cast<Index>(vertex.size()), a, b, stop);
  for (Index c = 0; c < chains.rows(); ++c) {
    const auto row = chains.row(c);
    const Index e = edge_to(mesh, vertex[row[0]], vertex[row[1]]);
    curves.add_curve({row.begin(), row.end()}, CurveKind::sharp, fold[slot_of_edge[e]].concave);
  }

  for (auto* near : {&out.near_convex, &out.near_concave}) near->assign(mesh.vertex_count(), 0);
  for (Index i : kept) {
    auto& near = fold[i].concave ? out.near_concave : out.near_convex;
    near[mesh.edge_v0[candidate[i]]] = near[mesh.edge_v1[candidate[i]]] = 1;
  }
  for (auto* near : {&out.near_convex, &out.near_concave})
    for (Index ring = 0; ring < options.suppression_rings; ++ring) {
      const std::vector<std::uint8_t> inner = *near;
      for_each(work, Cost::light, inner.size(), [&](std::size_t v) {
        for (Index w : mesh.vertex_vertices.row(static_cast<Index>(v))) (*near)[v] |= inner[w];
      });
    }
  return out;
}

}  // namespace intarsia::kernels
