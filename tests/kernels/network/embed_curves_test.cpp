#include "kernels/network/embed_curves.h"

#include <cmath>

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "engine/parallel/connect_mesh.h"
#include "kernels/network/arrange_face.h"

using namespace intarsia;
using namespace intarsia::kernels;

namespace {

Mesh grid(Index n) {
  Mesh m;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i) m.x.push_back(i), m.y.push_back(j), m.z.push_back(0);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index v = j * (n + 1) + i;
      m.corner.insert(m.corner.end(), {v, v + 1, v + n + 2, v, v + n + 2, v + n + 1});
    }
  connect_mesh(Work(), m);
  return m;
}

Real area(const MeshView& m, Index f) {
  const auto [a, b, c] = m.face(f);
  return (m.point(b) - m.point(a)).cross(m.point(c) - m.point(a)).z() / 2;
}

// Everything that must hold of any embedding.
void check_embedding(const Mesh& mesh, const CurveNetwork& curves, const Embedding& e) {
  const MeshView r = e.refined.mesh;
  std::vector<Real> covered(mesh.face_count(), 0);
  for (Index f = 0; f < r.face_count(); ++f) {
    CHECK(area(r, f) > 0);
    covered[e.refined.parent[f]] += area(r, f);
  }
  for (Index f = 0; f < mesh.face_count(); ++f) CHECK(covered[f] == doctest::Approx(area(mesh, f)).epsilon(1e-12));
  const auto euler = [](const MeshView& m) {
    return static_cast<int>(m.vertex_count()) - static_cast<int>(m.edge_count()) + static_cast<int>(m.face_count());
  };
  CHECK(euler(r) == euler(mesh));
  Real length = 0, expected = 0;
  for (Index edge : e.edge) length += (r.point(r.edge_v0[edge]) - r.point(r.edge_v1[edge])).norm();
  for (Index c = 0; c < curves.curve_count(); ++c) {
    const auto row = curves.curve.row(c);
    for (std::size_t i = 0; i + 1 < row.size(); ++i)
      expected += (position(mesh, curves.point[row[i]]) - position(mesh, curves.point[row[i + 1]])).norm();
  }
  CHECK(length == doctest::Approx(expected).epsilon(1e-9));
}

// A straight line y = s x + t across the grid, as crossings with grid edges.
void add_line(const Mesh& mesh, Real s, Real t, CurveNetwork& net) {
  const MeshView m = mesh;
  std::vector<std::pair<Real, SurfacePoint>> hit;
  for (Index e = 0; e < m.edge_count(); ++e) {
    const Vec3 a = m.point(m.edge_v0[e]), b = m.point(m.edge_v1[e]);
    const Real da = a.y() - s * a.x() - t, db = b.y() - s * b.x() - t;
    if (da * db < 0) {
      const Real w = da / (da - db);
      hit.push_back({a.x() + w * (b.x() - a.x()), SurfacePoint::on_edge(e, w)});
    }
  }
  std::sort(hit.begin(), hit.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  std::vector<Index> row;
  for (const auto& h : hit) row.push_back(static_cast<Index>(net.point.size())), net.point.push_back(h.second);
  net.add_curve(row, CurveKind::ridge);
}

}  // namespace

TEST_CASE("a line through a grid becomes edges and leaves areas as they were") {
  const Mesh mesh = grid(6);
  CurveNetwork net;
  add_line(mesh, 0.37, 1.13, net);
  const Embedding e = embed_curves(Work(), mesh, net);
  check_embedding(mesh, net, e);
  for (Index edge : e.edge) CHECK(e.refined.edge_kind[edge] == CurveKind::ridge);
}

TEST_CASE("crossing lines meet in a new vertex") {
  const Mesh mesh = grid(6);
  CurveNetwork net;
  add_line(mesh, 0.37, 1.13, net);
  add_line(mesh, -0.71, 5.05, net);
  const Index before = static_cast<Index>(net.point.size());
  const Embedding e = embed_curves(Work(), mesh, net);
  check_embedding(mesh, net, e);
  CHECK(e.refined.mesh.vertex_count() == mesh.vertex_count() + before + 1);
}

TEST_CASE("many random lines: the embedding stays a valid triangulation") {
  const Mesh mesh = grid(5);
  const Random random(7, 1);
  for (Index trial = 0; trial < 20; ++trial) {
    CurveNetwork net;
    for (Index k = 0; k < 6; ++k)
      add_line(mesh, 2 * random.uniform(trial, 2 * k) - 1, 5 * random.uniform(trial, 2 * k + 1), net);
    check_embedding(mesh, net, embed_curves(Work(), mesh, net));
  }
}

TEST_CASE("segments along edges, face points and a loop inside one face are embedded") {
  const Mesh mesh = grid(2);
  const MeshView m = mesh;
  CurveNetwork net;
  const Index diagonal = m.edge_between(0, 4);
  net.point = {SurfacePoint::at_vertex(0), SurfacePoint::on_edge(diagonal, 0.5), SurfacePoint::at_vertex(4)};
  net.add_curve({0, 1, 2}, CurveKind::sharp);
  net.point.push_back(SurfacePoint::in_face(0, 0.3, 0.4));
  net.point.push_back(SurfacePoint::in_face(0, 0.4, 0.4));
  net.point.push_back(SurfacePoint::in_face(0, 0.3, 0.5));
  net.add_curve({3, 4, 5, 3}, CurveKind::valley);
  net.add_curve({1, 3}, CurveKind::extension);
  const Embedding e = embed_curves(Work(), mesh, net);
  check_embedding(mesh, net, e);
  CHECK(e.edge.size() == 6);
}

TEST_CASE("an island without a bridge is tied to the border by a helper edge that carries no curve") {
  FaceArrangement a;
  a.point = {{0, 0}, {1, 0}, {0, 1}, {0.2, 0.2}, {0.4, 0.2}, {0.2, 0.4}};
  a.segment = {{3, 4, 0}, {4, 5, 1}, {5, 3, 2}};
  arrange_face(a);
  Real covered = 0;
  for (const auto& t : a.triangle) {
    const auto &p = a.point[t[0]], &q = a.point[t[1]], &r = a.point[t[2]];
    covered += ((q.u - p.u) * (r.v - p.v) - (q.v - p.v) * (r.u - p.u)) / 2;
  }
  CHECK(covered == doctest::Approx(0.5));
  CHECK(a.triangle.size() == 7);  // V = 6, three on the border: 2 * 6 - 2 - 3
}

TEST_CASE("points that share no face are refused") {
  const Mesh mesh = grid(3);
  CurveNetwork net;
  net.point = {SurfacePoint::at_vertex(0), SurfacePoint::at_vertex(15)};
  net.add_curve({0, 1}, CurveKind::ridge);
  CHECK_THROWS_AS(embed_curves(Work(), mesh, net), Error);
}
