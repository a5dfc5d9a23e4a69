#include "kernels/network/extend_curves.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/parallel/connect_mesh.h"
#include "kernels/network/prune_ends.h"

using namespace intarsia;
using namespace intarsia::kernels;

namespace {

// A surface with nothing embedded in it yet, its exact normals, and a direction field.
struct Scene {
  RefinedMesh refined;
  Vec3Array normal;
  DirectionField field;
  Real edge = 1;
  std::vector<std::uint8_t> active;

  void finish() {
    connect_mesh(Work(), refined.mesh);
    const std::size_t n = refined.mesh.vertex_count(), edges = refined.mesh.edge_count();
    for (Index v = 0; v < n; ++v) refined.origin.push_back(SurfacePoint::at_vertex(v));
    for (Index f = 0; f < refined.mesh.face_count(); ++f) refined.parent.push_back(f);
    refined.on_network.assign(edges, 0);
    refined.edge_kind.assign(edges, CurveKind::ridge);
    active.assign(edges, 0);
    for (Index e = 0; e < edges; ++e) active[e] = refined.mesh.edge_f1[e] == kNone;
    field.direction.resize(n);
    field.confidence.assign(n, 0), field.ridge.assign(n, 0), field.valley.assign(n, 0);
  }
  void set_direction(const Vec3& d, float confidence) {
    for (Index v = 0; v < refined.mesh.vertex_count(); ++v) {
      const Vec3 n = normal[v], t = d - d.dot(n) * n;
      field.direction.set(v, t.norm() > 0 ? Vec3(t.normalized()) : t);
      field.confidence[v] = confidence;
    }
  }
  Index nearest(const Vec3& p) const {
    const MeshView m = refined.mesh;
    Index best = 0;
    for (Index v = 0; v < m.vertex_count(); ++v)
      if ((m.point(v) - p).norm() < (m.point(best) - p).norm()) best = v;
    return best;
  }
  void seed(Index a, Index b) { active[refined.mesh.view().edge_between(a, b)] = 1; }
  // The seed along mesh edges that starts at p and goes on in direction d.
  Index seed_towards(const Vec3& p, const Vec3& d) {
    const MeshView m = refined.mesh;
    const Index v = nearest(p);
    Index best = kNone;
    Real along = -2;
    for (Index w : m.vertex_vertices.row(v)) {
      const Real c = (m.point(w) - m.point(v)).normalized().dot(d);
      if (c > along) along = c, best = w;
    }
    seed(v, best);
    return best;
  }
  ExtensionResult extend(const ExtensionOptions& options, Order order = Order::fixed) const {
    const Terrain terrain(refined, normal, field, refined.mesh.vertex_count(), edge);
    const std::atomic<bool> cancel{false};
    return extend_curves(Work(&cancel, nullptr, order), refined, active, terrain, options);
  }
  std::vector<Index> degrees(const ExtensionResult& r) const {
    std::vector<Index> degree(refined.mesh.vertex_count(), 0);
    std::vector<std::uint8_t> on(active);
    for (Index e : r.edge) on[e] = 1;
    for (Index e = 0; e < on.size(); ++e)
      if (on[e]) ++degree[refined.mesh.edge_v0[e]], ++degree[refined.mesh.edge_v1[e]];
    return degree;
  }
};

Scene triangular_grid(Index n) {
  Scene s;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i) {
      s.refined.mesh.x.push_back(i + 0.5 * (j % 2)), s.refined.mesh.y.push_back(j * std::sqrt(0.75));
      s.refined.mesh.z.push_back(0);
    }
  auto& c = s.refined.mesh.corner;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index v = j * (n + 1) + i, up = v + n + 1;
      if (j % 2 == 0) c.insert(c.end(), {v, v + 1, up, v + 1, up + 1, up});
      if (j % 2 == 1) c.insert(c.end(), {v, up + 1, up, v, v + 1, up + 1});
    }
  s.normal.resize(s.refined.mesh.x.size());
  for (std::size_t v = 0; v < s.normal.size(); ++v) s.normal.set(v, Vec3::UnitZ());
  s.finish();
  return s;
}

// Open cylinder of radius 10 around z, edges of about length 1.
Scene cylinder(Index around, Index along) {
  Scene s;
  for (Index j = 0; j <= along; ++j)
    for (Index i = 0; i < around; ++i) {
      const Real a = 2 * M_PI * i / around;
      s.refined.mesh.x.push_back(10 * std::cos(a)), s.refined.mesh.y.push_back(10 * std::sin(a));
      s.refined.mesh.z.push_back(j);
    }
  auto& c = s.refined.mesh.corner;
  for (Index j = 0; j < along; ++j)
    for (Index i = 0; i < around; ++i) {
      const Index v = j * around + i, w = j * around + (i + 1) % around, up = v + around, upw = w + around;
      if ((i + j) % 2 == 0) c.insert(c.end(), {v, w, up, w, upw, up});
      if ((i + j) % 2 == 1) c.insert(c.end(), {v, upw, up, v, w, upw});
    }
  for (std::size_t v = 0; v < s.refined.mesh.x.size(); ++v) {
    s.normal.resize(v + 1);
    s.normal.set(v, Vec3(s.refined.mesh.x[v], s.refined.mesh.y[v], 0) / 10);
  }
  s.finish();
  return s;
}

ExtensionOptions far_reaching() {
  ExtensionOptions o;
  o.max_length = 1e9;
  return o;
}

// How far the far end of the curve lies beside the line through `from` with direction d.
Real drift(const Scene& s, const ExtensionResult& r, const Vec3& from, const Vec3& d) {
  const MeshView m = s.refined.mesh;
  Real furthest = 0, aside = 0;
  for (Index e : r.edge)
    for (Index v : {m.edge_v0[e], m.edge_v1[e]}) {
      const Vec3 p = m.point(v) - from;
      if (p.dot(d) > furthest && p.dot(d) < 36) furthest = p.dot(d), aside = (p - p.dot(d) * d).norm();
    }
  CHECK(furthest > 30);
  return aside;
}

}  // namespace

TEST_CASE("with feedback a curve follows the field, not the mesh; without it drifts by many edges") {
  for (int degrees = 0; degrees <= 90; degrees += 10) {
    const Real a = degrees * M_PI / 180;
    const Vec3 d(std::cos(a), std::sin(a), 0), middle(50, 43, 0);
    Scene s = triangular_grid(100);
    s.set_direction(d, 1);
    const Index far = s.seed_towards(middle, d);
    ExtensionOptions o = far_reaching();
    o.walk_weight = 0.2;
    const Vec3 from = s.refined.mesh.view().point(far);
    CHECK(drift(s, s.extend(o), from, d) <= 1.2);
  }
  Scene s = triangular_grid(100);
  const Vec3 d(std::cos(M_PI / 9), std::sin(M_PI / 9), 0);
  s.set_direction(d, 1);
  const Index far = s.seed_towards({50, 43, 0}, d);
  ExtensionOptions letter = far_reaching();
  letter.feedback = 0, letter.walk_weight = 0.2, letter.cone = 60;
  CHECK(drift(s, s.extend(letter), s.refined.mesh.view().point(far), d) > 5);
}

TEST_CASE("a seed along the axis of a cylinder runs straight to both rims") {
  Scene s = cylinder(62, 40);
  s.set_direction(Vec3::UnitZ(), 1);
  s.seed_towards({10, 0, 20}, Vec3::UnitZ());
  const ExtensionResult r = s.extend(far_reaching());
  CHECK(r.ends == 2);
  CHECK(r.met == 2);
  const MeshView m = s.refined.mesh;
  const Vec3 start = m.point(s.nearest({10, 0, 20}));
  for (Index e : r.edge) {
    const Vec3 p = m.point(m.edge_v0[e]);
    CHECK((Vec3(p.x(), p.y(), 0) - Vec3(start.x(), start.y(), 0)).norm() < 1.1);
  }
}

TEST_CASE("a seed around a cylinder closes on itself") {
  Scene s = cylinder(62, 40);
  s.set_direction(Vec3(0, 0, 0), 0);
  s.seed_towards({10, 0, 20}, Vec3::UnitY());
  const ExtensionResult r = s.extend(far_reaching());
  CHECK(r.met == 2);
  CHECK(r.edge.size() >= 60);
  CHECK(r.edge.size() <= 64);
  for (Index d : s.degrees(r)) CHECK((d == 0 || d == 2 || d == 3 || d == 4));
}

TEST_CASE("two perpendicular seeds aimed at one point meet without crossing, in every order of events") {
  for (const Order order : {Order::fixed, Order::relaxed})
    for (const bool queue : {false, true}) {
      Scene s = triangular_grid(60);
      s.seed_towards({10, 25, 0}, Vec3::UnitX());
      s.seed_towards({30, 5, 0}, Vec3::UnitY());
      ExtensionOptions o = far_reaching();
      o.paper_queue = queue;
      const ExtensionResult r = s.extend(o, order);
      CHECK(r.ends == 4);
      CHECK(r.met == 4);
      CHECK(r.dead == 0);
      for (Index d : s.degrees(r)) CHECK(d != 1);
    }
}

TEST_CASE("a hundred seeds grow side by side in the relaxed order: only ends that meet share an edge") {
  Scene s = triangular_grid(90);
  for (Index i = 0; i < 100; ++i) {
    const Real angle = 2.4 * i;  // the golden angle: no two alike
    s.seed_towards({9.0 * (i % 10) + 5, 7.5 * (i / 10) + 5, 0}, Vec3(std::cos(angle), std::sin(angle), 0));
  }
  ExtensionResult r = s.extend(far_reaching(), Order::relaxed);
  CHECK(r.ends == 200);
  CHECK(r.met + r.bridged + r.dead == r.ends);
  CHECK(r.met > 100);
  for (const Index e : r.edge) CHECK(s.active[e] == 0);
  std::sort(r.edge.begin(), r.edge.end());
  for (std::size_t i = 2; i < r.edge.size(); ++i) CHECK(r.edge[i] != r.edge[i - 2]);
}

TEST_CASE("an end that runs into a corner takes the shortest way; what stays loose is pruned") {
  Scene s = triangular_grid(30);
  s.seed_towards({15, 13, 0}, Vec3::UnitX());
  ExtensionOptions o;
  o.max_length = 2;
  o.max_gap = 40;
  ExtensionResult r = s.extend(o);
  CHECK(r.bridged == 2);
  for (Index d : s.degrees(r)) CHECK(d != 1);
  o.max_gap = 1;
  r = s.extend(o);
  CHECK(r.dead == 2);
  std::vector<std::uint8_t> on(s.active);
  for (Index e : r.edge) on[e] = 1;
  const Index cleared = prune_ends(Work(), s.refined.mesh, on);
  CHECK(cleared == r.edge.size() + 1);
  for (Index e = 0; e < on.size(); ++e) CHECK((on[e] == 1) == (s.refined.mesh.edge_f1[e] == kNone));
}
