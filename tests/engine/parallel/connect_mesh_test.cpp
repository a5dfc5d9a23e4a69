#include "engine/parallel/connect_mesh.h"

#include <doctest/doctest.h>

using namespace intarsia;

namespace {
Mesh tetrahedron() {
  Mesh m;
  m.x = {0, 1, 0, 0}, m.y = {0, 0, 1, 0}, m.z = {0, 0, 0, 1};
  m.corner = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
  return m;
}
}  // namespace

TEST_CASE("a tetrahedron has six edges, each between two faces") {
  Mesh m = tetrahedron();
  connect_mesh(Work(), m);
  CHECK(m.edge_v0 == std::vector<Index>{0, 0, 0, 1, 1, 2});
  CHECK(m.edge_v1 == std::vector<Index>{1, 2, 3, 2, 3, 3});
  for (Index e = 0; e < 6; ++e) CHECK(m.edge_f0[e] < m.edge_f1[e]);
  for (Index f = 0; f < 4; ++f)
    for (int i = 0; i < 3; ++i) {
      const Index e = m.face_edge[3 * f + i], v = m.corner[3 * f + i];
      CHECK(m.edge_v0[e] != v);
      CHECK(m.edge_v1[e] != v);
      const bool touches = m.edge_f0[e] == f || m.edge_f1[e] == f;
      CHECK(touches);
    }
  for (Index v = 0; v < 4; ++v) {
    CHECK(m.vertex_faces.row(v).size() == 3);
    CHECK(m.vertex_vertices.row(v).size() == 3);
  }
}

TEST_CASE("an open triangle has boundary edges only") {
  Mesh m;
  m.x = {0, 1, 0}, m.y = {0, 0, 1}, m.z = {0, 0, 0};
  m.corner = {0, 1, 2};
  connect_mesh(Work(), m);
  for (Index e = 0; e < 3; ++e) CHECK(m.view().is_boundary_edge(e));
  CHECK(m.view().edge_between(0, 2) == 1);
  CHECK(m.view().edge_between(2, 0) == 1);
}

TEST_CASE("a turned face and a third face on an edge are refused with the face's id") {
  Mesh turned = tetrahedron();
  std::swap(turned.corner[9], turned.corner[10]);
  CHECK_THROWS_AS(connect_mesh(Work(), turned), Error);
  Mesh fan = tetrahedron();
  fan.x.push_back(1), fan.y.push_back(1), fan.z.push_back(1);
  fan.corner.insert(fan.corner.end(), {0, 1, 4});
  try {
    connect_mesh(Work(), fan);
    FAIL("accepted an edge with three faces");
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::rejected);
    CHECK(e.element() == 0);
  }
}
