#include "engine/space/surface_path.h"

#include <algorithm>

namespace intarsia {
namespace {

constexpr int kMostWalkSteps = 64;
constexpr int kMostSectionSteps = 512;

int edge_slot(const MeshView& mesh, Index f, Index e) {
  for (int i = 0; i < 3; ++i)
    if (mesh.face_edge[3 * f + i] == e) return i;
  return 3;
}

Vec3 normal_at(const MeshView& mesh, const SurfacePoint& p) {
  Vec3 n = Vec3::Zero();
  switch (p.kind) {
    case PointKind::vertex:
      for (Index f : mesh.vertex_faces.row(p.element)) n += area_normal(mesh, f);
      break;
    case PointKind::edge:
      // Unit normals: the mean plane of the two sides, whatever their areas.
      n += area_normal(mesh, mesh.edge_f0[p.element]).stableNormalized();
      if (mesh.edge_f1[p.element] != kNone) n += area_normal(mesh, mesh.edge_f1[p.element]).stableNormalized();
      break;
    case PointKind::face:
      n = area_normal(mesh, p.element);
      break;
  }
  const Real norm = n.norm();
  return norm > 0 ? Vec3(n / norm) : Vec3(Vec3::Zero());
}

// Weights of the foot of x in the plane of face f; false for a face too thin to have a plane.
bool project(const MeshView& mesh, Index f, const Vec3& x, std::array<Real, 3>& w) {
  const auto [i, j, k] = mesh.face(f);
  const Vec3 a = mesh.point(i), u = mesh.point(j) - a, v = mesh.point(k) - a, d = x - a;
  const Real uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), det = uu * vv - uv * uv;
  const Real size = std::max(uu, vv);
  if (!(det > 1e-12 * size * size)) return false;
  const Real du = d.dot(u), dv = d.dot(v);
  w[1] = (vv * du - uv * dv) / det;
  w[2] = (uu * dv - uv * du) / det;
  w[0] = 1 - w[1] - w[2];
  return true;
}

struct Section {
  const MeshView& mesh;
  Vec3 origin, along, normal;

  Real height(Index v) const { return normal.dot(mesh.point(v) - origin); }
  bool crosses(Index e) const { return (height(mesh.edge_v0[e]) >= 0) != (height(mesh.edge_v1[e]) >= 0); }
  Real crossing(Index e) const {
    const Real a = height(mesh.edge_v0[e]), b = height(mesh.edge_v1[e]);
    return std::clamp(a / (a - b), Real{0}, Real{1});
  }
  // How straight ahead the crossing of e lies: cosine to `along`.
  Real ahead(Index e) const {
    const Vec3 d = intarsia::position(mesh, SurfacePoint::on_edge(e, crossing(e))) - origin;
    const Real norm = d.norm();
    return norm > 0 ? d.dot(along) / norm : -1;
  }
};

}  // namespace

bool is_on_face(const MeshView& mesh, const SurfacePoint& p, Index f) {
  switch (p.kind) {
    case PointKind::vertex:
      return mesh.corner_of(f, p.element) < 3;
    case PointKind::edge:
      return mesh.edge_f0[p.element] == f || mesh.edge_f1[p.element] == f;
    case PointKind::face:
      return p.element == f;
  }
  return false;
}

std::array<Real, 3> weights_in_face(const MeshView& mesh, const SurfacePoint& p, Index f) {
  std::array<Real, 3> w{};
  switch (p.kind) {
    case PointKind::vertex:
      w[mesh.corner_of(f, p.element)] = 1;
      break;
    case PointKind::edge:
      w[mesh.corner_of(f, mesh.edge_v0[p.element])] = 1 - p.a;
      w[mesh.corner_of(f, mesh.edge_v1[p.element])] = p.a;
      break;
    case PointKind::face:
      w = {p.a, p.b, 1 - p.a - p.b};
      break;
  }
  return w;
}

FacePoint to_face_point(const MeshView& mesh, const SurfacePoint& p) {
  Index f = p.element;
  if (p.kind == PointKind::vertex) f = mesh.vertex_faces.row(p.element)[0];
  if (p.kind == PointKind::edge) f = mesh.edge_f0[p.element];
  return {f, weights_in_face(mesh, p, f)};
}

std::array<Index, 2> shared_faces(const MeshView& mesh, const SurfacePoint& p, const SurfacePoint& q) {
  std::array<Index, 2> found{kNone, kNone};
  int n = 0;
  const auto test = [&](Index f, const SurfacePoint& other) {
    if (f != kNone && n < 2 && is_on_face(mesh, other, f)) found[n++] = f;
  };
  const bool from_q = static_cast<int>(q.kind) > static_cast<int>(p.kind);  // the point with fewer faces
  const SurfacePoint &few = from_q ? q : p, &many = from_q ? p : q;
  switch (few.kind) {
    case PointKind::vertex:
      for (Index f : mesh.vertex_faces.row(few.element)) test(f, many);
      break;
    case PointKind::edge:
      test(mesh.edge_f0[few.element], many);
      test(mesh.edge_f1[few.element], many);
      break;
    case PointKind::face:
      test(few.element, many);
      break;
  }
  return found;
}

FacePoint walk_towards(const MeshView& mesh, FacePoint p, const Vec3& target) {
  Index entered = kNone;
  std::array<Real, 3> q;
  if (!project(mesh, p.face, target, q)) return p;
  for (int step = 0; step < kMostWalkSteps; ++step) {
    int exit = 3;
    Real share = 1;
    for (int i = 0; i < 3; ++i) {
      if (q[i] >= 0) continue;
      const Real s = p.weight[i] / (p.weight[i] - q[i]);
      if (exit == 3 || s < share || (s == share && q[i] < q[exit])) exit = i, share = s;
    }
    if (exit == 3) return {p.face, q};
    Real total = 0;
    for (int i = 0; i < 3; ++i) {
      p.weight[i] = i == exit ? 0 : std::max(Real{0}, p.weight[i] + share * (q[i] - p.weight[i]));
      total += p.weight[i];
    }
    for (Real& w : p.weight) w /= total;
    const Index e = mesh.face_edge[3 * p.face + exit], g = mesh.other_face(e, p.face);
    if (g == kNone || e == entered) return p;
    FacePoint next{g, {}};
    for (int i = 0; i < 3; ++i)
      if (i != exit) next.weight[mesh.corner_of(g, mesh.corner[3 * p.face + i])] = p.weight[i];
    if (!project(mesh, g, target, q)) return p;
    p = next;
    entered = e;
  }
  return p;
}

bool section_crossings(const MeshView& mesh, const SurfacePoint& from, const SurfacePoint& to, Real margin,
                       std::vector<SurfacePoint>& crossings) {
  if (shared_faces(mesh, from, to)[0] != kNone) return true;
  const Vec3 a = intarsia::position(mesh, from), b = intarsia::position(mesh, to);
  const Vec3 along = b - a, normal = along.cross(normal_at(mesh, from) + normal_at(mesh, to));
  const Real reach = along.norm(), tilt = normal.norm();
  if (!(reach > 0) || !(tilt > 1e-6 * reach)) return false;
  const Section cut{mesh, a, along / reach, normal / tilt};

  // The first edge crossed: of all that the section leaves by, the one straightest ahead.
  Index face = kNone, edge = kNone;
  Real best = 0;
  const auto offer = [&](Index f, Index e) {
    if (!cut.crosses(e)) return;
    const Real s = cut.ahead(e);
    if (s > best || (s == best && edge != kNone && e < edge)) best = s, face = f, edge = e;
  };
  const auto offer_face = [&](Index f, auto skip) {
    for (int i = 0; i < 3; ++i) {
      const Index e = mesh.face_edge[3 * f + i];
      if (!skip(e)) offer(f, e);
    }
  };
  switch (from.kind) {
    case PointKind::vertex:
      for (Index f : mesh.vertex_faces.row(from.element))
        offer(f, mesh.face_edge[3 * f + mesh.corner_of(f, from.element)]);
      break;
    case PointKind::edge:
      for (Index f : {mesh.edge_f0[from.element], mesh.edge_f1[from.element]})
        if (f != kNone) offer_face(f, [&](Index e) { return e == from.element; });
      break;
    case PointKind::face:
      offer_face(from.element, [](Index) { return false; });
      break;
  }
  if (edge == kNone) return false;

  const std::size_t start = crossings.size();
  for (int step = 0; step < kMostSectionSteps; ++step) {
    const SurfacePoint x = SurfacePoint::on_edge(edge, std::clamp(cut.crossing(edge), margin, 1 - margin));
    const Real passed = cut.along.dot(intarsia::position(mesh, x) - a);
    face = mesh.other_face(edge, face);
    if (face == kNone || passed > 2 * reach || passed < -reach) break;
    crossings.push_back(x);
    if (is_on_face(mesh, to, face)) return true;
    const int slot = edge_slot(mesh, face, edge);
    const Index apex = mesh.corner[3 * face + slot];
    const bool side = cut.height(apex) >= 0;
    // The section leaves between the apex and the end of the entry edge on its other side.
    for (int i = 1; i < 3; ++i) {
      const Index end = mesh.corner[3 * face + (slot + i) % 3];
      if ((cut.height(end) >= 0) != side) {
        edge = mesh.face_edge[3 * face + (slot + 3 - i) % 3];
        break;
      }
    }
  }
  crossings.resize(start);
  return false;
}

}  // namespace intarsia
