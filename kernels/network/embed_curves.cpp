#include "kernels/network/embed_curves.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "engine/parallel/compact.h"
#include "engine/parallel/connect_mesh.h"
#include "engine/parallel/scan.h"
#include "engine/parallel/sort.h"
#include "kernels/network/arrange_face.h"

namespace intarsia::kernels {
namespace {

constexpr Real kMerge = 1e-6;  // of an edge's length

struct Segment {
  Index host;  // edge id, or edge count + face id
  Index a, b;  // refined vertices, a < b
  Index curve;
  auto key() const { return std::tie(host, a, b, curve); }
};

// Points of the curves as refined vertices: originals first, then edge points by (edge, position), then face points.
struct Nodes {
  std::vector<SurfacePoint> extra;  // the vertices beyond the original ones
  std::vector<Index> of_point;
  Index edge_points = 0;  // extra[0 .. edge_points) lie on edges, ordered by (edge, position)
};

SurfacePoint canonical(const MeshView& mesh, const SurfacePoint& p) {
  if (p.kind == PointKind::edge && p.a < kMerge) return SurfacePoint::at_vertex(mesh.edge_v0[p.element]);
  if (p.kind == PointKind::edge && p.a > 1 - kMerge) return SurfacePoint::at_vertex(mesh.edge_v1[p.element]);
  return p;
}

Nodes number_nodes(const Work& work, const MeshView& mesh, const CurveNetwork& curves) {
  const Index n = static_cast<Index>(curves.point.size());
  std::vector<SurfacePoint> point(n);
  for (Index i = 0; i < n; ++i) point[i] = canonical(mesh, curves.point[i]);
  std::vector<Index> order = compact(work, n, [&](std::size_t i) { return point[i].kind != PointKind::vertex; });
  const auto key = [&](Index i) {
    const SurfacePoint& p = point[i];
    return std::tuple(p.kind, p.element, p.a, p.b, i);
  };
  sort_total(work, order.begin(), order.end(), [&](Index i, Index j) { return key(i) < key(j); });
  Nodes nodes;
  nodes.of_point.resize(n);
  for (Index i = 0; i < n; ++i) nodes.of_point[i] = point[i].element;
  for (Index i : order) {
    const SurfacePoint& p = point[i];
    const bool same = !nodes.extra.empty() && nodes.extra.back().kind == p.kind &&
                      nodes.extra.back().element == p.element && p.a - nodes.extra.back().a < kMerge &&
                      std::abs(p.b - nodes.extra.back().b) < kMerge;
    if (!same) {
      nodes.extra.push_back(p);
      if (p.kind == PointKind::edge) ++nodes.edge_points;
    }
    nodes.of_point[i] = mesh.vertex_count() + static_cast<Index>(nodes.extra.size()) - 1;
  }
  return nodes;
}

class Embedder {
 public:
  Embedder(const Work& work, const MeshView& mesh, const CurveNetwork& curves)
      : work_(work), mesh_(mesh), curves_(curves), nodes_(number_nodes(work, mesh, curves)) {
    edge_start_.assign(std::size_t{mesh.edge_count()} + 1, 0);
    for (Index i = 0; i < nodes_.edge_points; ++i) ++edge_start_[nodes_.extra[i].element];
    exclusive_scan<Index>(work, edge_start_);
  }

  Embedding run() {
    collect_segments();
    arrange_touched_faces();
    write_faces();
    connect_faces(work_, out_.refined.mesh);
    mark_network();
    out_.point_vertex = std::move(nodes_.of_point);
    return std::move(out_);
  }

 private:
  SurfacePoint where(Index node) const {
    return node < mesh_.vertex_count() ? SurfacePoint::at_vertex(node) : nodes_.extra[node - mesh_.vertex_count()];
  }
  bool on_edge(const SurfacePoint& p, Index e) const {
    return p.kind == PointKind::edge
               ? p.element == e
               : p.kind == PointKind::vertex && (mesh_.edge_v0[e] == p.element || mesh_.edge_v1[e] == p.element);
  }
  bool in_face(const SurfacePoint& p, Index f) const {
    if (p.kind == PointKind::face) return p.element == f;
    if (p.kind == PointKind::vertex) return mesh_.corner_of(f, p.element) < 3;
    return mesh_.edge_f0[p.element] == f || mesh_.edge_f1[p.element] == f;
  }
  std::span<const Index> faces_of(const SurfacePoint& p, std::array<Index, 2>& buffer) const {
    if (p.kind == PointKind::vertex) return mesh_.vertex_faces.row(p.element);
    buffer = {p.element, kNone};
    if (p.kind == PointKind::face) return {buffer.data(), 1};
    buffer = {mesh_.edge_f0[p.element], mesh_.edge_f1[p.element]};
    return {buffer.data(), buffer[1] == kNone ? std::size_t{1} : std::size_t{2}};
  }
  // The edge or face that holds the segment between two nodes, or kNone.
  Index host_of(Index a, Index b) const {
    const SurfacePoint p = where(a), q = where(b);
    std::array<Index, 2> buffer;
    for (Index f : faces_of(p, buffer)) {
      if (!in_face(q, f)) continue;
      for (int i = 0; i < 3; ++i) {
        const Index e = mesh_.face_edge[3 * f + i];
        if (on_edge(p, e) && on_edge(q, e)) return e;
      }
      return mesh_.edge_count() + f;
    }
    return kNone;
  }

  void collect_segments() {
    for (Index c = 0; c < curves_.curve_count(); ++c) {
      const auto row = curves_.curve.row(c);
      for (std::size_t i = 0; i + 1 < row.size(); ++i) {
        const Index a = nodes_.of_point[row[i]], b = nodes_.of_point[row[i + 1]];
        if (a == b) continue;
        const Index host = host_of(a, b);
        if (host == kNone) throw Error(ErrorCode::internal, "two consecutive curve points share no face", c);
        segments_.push_back({host, std::min(a, b), std::max(a, b), c});
      }
      if (c % 1024 == 0) work_.check();
    }
    sort_total(work_, segments_.begin(), segments_.end(),
               [](const Segment& s, const Segment& t) { return s.key() < t.key(); });
  }

  std::span<const Segment> segments_on(Index host) const {
    const auto less = [](const Segment& s, Index h) { return s.host < h; };
    const auto first = std::lower_bound(segments_.begin(), segments_.end(), host, less);
    const auto last = std::lower_bound(first, segments_.end(), host + 1, less);
    return {first, last};
  }

  std::span<const SurfacePoint> points_on(Index e) const {
    return std::span(nodes_.extra).subspan(edge_start_[e], edge_start_[e + 1] - edge_start_[e]);
  }

  // The border of face f counter-clockwise from corner 0, as refined vertices with reference coordinates.
  void list_border(Index f, FaceArrangement& a, std::vector<Index>& vertex) const {
    constexpr PlanePoint kCorner[3] = {{0, 0}, {1, 0}, {0, 1}};
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const Index e = mesh_.face_edge[3 * f + (i + 2) % 3], v = mesh_.corner[3 * f + i];
      vertex.push_back(v);
      a.point.push_back(kCorner[i]);
      const auto points = points_on(e);
      const bool forward = mesh_.edge_v0[e] == v;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const std::size_t at = forward ? k : points.size() - 1 - k;
        const Real t = forward ? points[at].a : 1 - points[at].a;
        vertex.push_back(mesh_.vertex_count() + edge_start_[e] + static_cast<Index>(at));
        a.point.push_back(
            {kCorner[i].u + t * (kCorner[j].u - kCorner[i].u), kCorner[i].v + t * (kCorner[j].v - kCorner[i].v)});
      }
    }
    a.boundary = static_cast<Index>(vertex.size());
  }

  struct Touched {
    FaceArrangement a;
    std::vector<Index> vertex;  // refined vertex of the given points; crossings get theirs after the scan
  };

  void arrange_touched_faces() {
    std::vector<std::uint8_t> touched(mesh_.face_count(), 0);
    for (Index i = 0; i < nodes_.extra.size(); ++i) {
      std::array<Index, 2> buffer;
      for (Index f : faces_of(nodes_.extra[i], buffer)) touched[f] = 1;
    }
    for (const Segment& s : segments_)
      if (s.host >= mesh_.edge_count()) touched[s.host - mesh_.edge_count()] = 1;
    faces_ = compact(work_, touched.size(), [&](std::size_t f) { return touched[f] != 0; });
    arrangement_.resize(faces_.size());
    for_each(work_, Cost::heavy, faces_.size(), [&](std::size_t i) { arrange_one(faces_[i], arrangement_[i]); });
    crossing_start_.resize(faces_.size());
    for (std::size_t i = 0; i < faces_.size(); ++i)
      crossing_start_[i] = static_cast<Index>(arrangement_[i].a.point.size() - arrangement_[i].vertex.size());
    crossings_ = exclusive_scan<Index>(work_, crossing_start_);
  }

  void arrange_one(Index f, Touched& t) const {
    list_border(f, t.a, t.vertex);
    const auto local = [&](Index node) {
      for (Index i = 0; i < t.vertex.size(); ++i)
        if (t.vertex[i] == node) return i;
      const SurfacePoint& p = nodes_.extra[node - mesh_.vertex_count()];
      t.vertex.push_back(node);
      t.a.point.push_back({p.b, 1 - p.a - p.b});
      return static_cast<Index>(t.vertex.size() - 1);
    };
    const auto first = std::lower_bound(nodes_.extra.begin() + nodes_.edge_points, nodes_.extra.end(), f,
                                        [](const SurfacePoint& p, Index face) { return p.element < face; });
    for (auto p = first; p != nodes_.extra.end() && p->element == f; ++p)
      local(mesh_.vertex_count() + static_cast<Index>(p - nodes_.extra.begin()));
    Index last_a = kNone, last_b = kNone;
    for (const Segment& s : segments_on(mesh_.edge_count() + f)) {
      if (s.a == last_a && s.b == last_b) continue;
      last_a = s.a, last_b = s.b;
      t.a.segment.push_back({local(s.a), local(s.b), static_cast<Index>(&s - segments_.data())});
    }
    t.a.given = static_cast<Index>(t.a.point.size());
    arrange_face(t.a);
  }

  Index refined_vertex(std::size_t i, Index local) const {
    const Touched& t = arrangement_[i];
    if (local < t.vertex.size()) return t.vertex[local];
    return mesh_.vertex_count() + static_cast<Index>(nodes_.extra.size()) + crossing_start_[i] + local -
           static_cast<Index>(t.vertex.size());
  }

  void write_vertices() {
    const Index originals = mesh_.vertex_count();
    const std::size_t n = originals + nodes_.extra.size() + crossings_;
    RefinedMesh& r = out_.refined;
    std::vector<SurfacePoint> added(nodes_.extra);
    added.resize(nodes_.extra.size() + crossings_);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      for (Index k = static_cast<Index>(arrangement_[i].vertex.size()); k < arrangement_[i].a.point.size(); ++k) {
        const PlanePoint& p = arrangement_[i].a.point[k];
        added[refined_vertex(i, k) - originals] = SurfacePoint::in_face(faces_[i], 1 - p.u - p.v, p.u);
      }
    r.origin = VertexOrigins(originals, std::move(added));
    r.mesh.x.resize(n), r.mesh.y.resize(n), r.mesh.z.resize(n);
    for_each(work_, Cost::light, n, [&](std::size_t v) {
      const Vec3 p = position(mesh_, r.origin[v]);
      r.mesh.x[v] = p.x(), r.mesh.y[v] = p.y(), r.mesh.z[v] = p.z();
    });
  }

  void write_faces() {
    write_vertices();
    const Index faces = mesh_.face_count();
    std::vector<Index> start(faces, 1);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      start[faces_[i]] = static_cast<Index>(arrangement_[i].a.triangle.size());
    const Index total = exclusive_scan<Index>(work_, start);
    RefinedMesh& r = out_.refined;
    r.mesh.corner.resize(std::size_t{total} * 3);
    r.parent.resize(total);
    for_each(work_, Cost::light, faces, [&](std::size_t f) {
      const Index next = f + 1 < faces ? start[f + 1] : total;
      for (Index k = start[f]; k < next; ++k) r.parent[k] = static_cast<Index>(f);
      if (next - start[f] == 1)
        for (int i = 0; i < 3; ++i) r.mesh.corner[3 * start[f] + i] = mesh_.corner[3 * f + i];
    });
    for_each(work_, Cost::medium, faces_.size(), [&](std::size_t i) {
      const auto& triangle = arrangement_[i].a.triangle;
      for (std::size_t k = 0; k < triangle.size(); ++k)
        for (int j = 0; j < 3; ++j) r.mesh.corner[3 * (start[faces_[i]] + k) + j] = refined_vertex(i, triangle[k][j]);
    });
  }

  // Every refined edge that a curve runs along, with the curve.
  std::vector<std::pair<Index, Index>> carried_edges() const {
    const MeshView m = out_.refined.mesh;
    std::vector<std::pair<Index, Index>> carried;
    const auto carry = [&](Index a, Index b, Index curve) {
      const Index e = m.edge_between(a, b);
      if (e == kNone) throw Error(ErrorCode::internal, "a curve segment was lost in the embedding", curve);
      carried.emplace_back(e, curve);
    };
    for (const Segment& s : segments_) {
      if (s.host >= mesh_.edge_count()) continue;
      const Real from = parameter(s.host, s.a), to = parameter(s.host, s.b);
      Index last = from < to ? s.a : s.b;
      const Index end = from < to ? s.b : s.a;
      const auto points = points_on(s.host);
      for (std::size_t k = 0; k < points.size(); ++k) {
        if (points[k].a <= std::min(from, to) || points[k].a >= std::max(from, to)) continue;
        const Index v = mesh_.vertex_count() + edge_start_[s.host] + static_cast<Index>(k);
        carry(last, v, s.curve);
        last = v;
      }
      carry(last, end, s.curve);
    }
    for (std::size_t i = 0; i < faces_.size(); ++i)
      for (const FaceSegment& s : arrangement_[i].a.segment) {
        if (s.tag == kNone) continue;
        const Segment& tagged = segments_[s.tag];
        for (std::size_t k = s.tag; k < segments_.size() && segments_[k].host == tagged.host &&
                                    segments_[k].a == tagged.a && segments_[k].b == tagged.b;
             ++k)
          carry(refined_vertex(i, s.a), refined_vertex(i, s.b), segments_[k].curve);
      }
    return carried;
  }

  Real parameter(Index edge, Index node) const {
    if (node == mesh_.edge_v0[edge]) return 0;
    if (node == mesh_.edge_v1[edge]) return 1;
    return nodes_.extra[node - mesh_.vertex_count()].a;
  }

  void mark_network() {
    RefinedMesh& r = out_.refined;
    const std::size_t edges = r.mesh.edge_count();
    r.on_network.assign(edges, 0);
    r.edge_kind.assign(edges, CurveKind::subdivision);
    r.edge_strength.resize(edges);
    auto carried = carried_edges();
    std::sort(carried.begin(), carried.end());
    carried.erase(std::unique(carried.begin(), carried.end()), carried.end());
    const std::vector<Real> strength = vertex_strength();
    for (const auto& [e, c] : carried) {
      out_.edge.push_back(e), out_.edge_curve.push_back(c);
      if (!r.on_network[e] || ranks_before(curves_.kind[c], r.edge_kind[e])) r.edge_kind[e] = curves_.kind[c];
      r.on_network[e] = 1;
      if (!strength.empty()) r.edge_strength.set(e, (strength[r.mesh.edge_v0[e]] + strength[r.mesh.edge_v1[e]]) / 2);
    }
    for_each(work_, Cost::light, edges, [&](std::size_t e) {
      if (r.mesh.edge_f1[e] != kNone || r.on_network[e]) return;
      r.on_network[e] = 1;
      r.edge_kind[e] = CurveKind::border;
    });
  }

  // Per refined vertex the largest strength of the curve points that became it; empty where no strength is known.
  std::vector<Real> vertex_strength() const {
    std::vector<Real> strength;
    if (curves_.strength.empty()) return strength;
    strength.assign(out_.refined.mesh.vertex_count(), 0);
    for (std::size_t i = 0; i < curves_.point.size(); ++i)
      strength[nodes_.of_point[i]] = std::max(strength[nodes_.of_point[i]], curves_.strength[i]);
    return strength;
  }

  const Work& work_;
  const MeshView& mesh_;
  const CurveNetwork& curves_;
  Nodes nodes_;
  std::vector<Index> edge_start_;  // edge -> first of its points in nodes_.extra
  std::vector<Segment> segments_;
  std::vector<Index> faces_;          // touched faces, ascending
  std::vector<Touched> arrangement_;  // per touched face
  std::vector<Index> crossing_start_;
  Index crossings_ = 0;
  Embedding out_;
};

}  // namespace

Embedding embed_curves(const Work& work, const MeshView& mesh, const CurveNetwork& curves) {
  return Embedder(work, mesh, curves).run();
}

}  // namespace intarsia::kernels
