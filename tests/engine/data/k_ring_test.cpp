#include "engine/data/k_ring.h"

#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "tests/support/raw_mesh.h"

using namespace intarsia;
using namespace intarsia::test;

TEST_CASE("rings of an inner vertex of the regular triangulation") {
  const Mesh m = raw_mesh(plane(20, 20));
  const Index v = 10 * 21 + 10;
  RingWalker walker(m);
  walker.walk(v, 6);
  walker.collect_faces(6);
  CHECK(walker.depth() == 6);
  CHECK(walker.centre() == v);
  std::set<Index> seen{v};
  for (int k = 1; k <= 6; ++k) {
    CHECK(walker.ring(k).size() == static_cast<std::size_t>(6 * k));
    CHECK(walker.vertices(k).size() == static_cast<std::size_t>(3 * k * (k + 1)));
    CHECK(walker.faces(k).size() == static_cast<std::size_t>(6 * k * k));
    for (Index w : walker.ring(k)) CHECK(seen.insert(w).second);
    CHECK(walker.faces(k).data() == walker.faces(1).data());
  }
  CHECK(walker.ring(7).empty());
}

TEST_CASE("rings of the five-valent vertices of an icosphere") {
  const Mesh m = raw_mesh(icosphere(4));
  RingWalker walker(m);
  int poles = 0;
  for (Index v = 0; v < m.vertex_count(); ++v) {
    if (m.vertex_vertices.row(v).size() != 5) continue;
    ++poles;
    walker.walk(v, 4);
    walker.collect_faces(4);
    for (int k = 1; k <= 4; ++k) {
      CHECK(walker.vertices(k).size() == static_cast<std::size_t>(5 * k * (k + 1) / 2));
      CHECK(walker.faces(k).size() == static_cast<std::size_t>(5 * k * k));
    }
  }
  CHECK(poles == 12);
}

TEST_CASE("faces of N_k are those with a vertex within k - 1, also after extending") {
  const Mesh m = raw_mesh(plane(9, 7, Diagonals::alternating));
  RingWalker walker(m);
  for (Index v : {Index{0}, Index{33}, Index{79}}) {
    walker.walk(v, 1);
    walker.extend(3);
    walker.collect_faces(4);
    std::vector<int> distance(m.vertex_count(), 99);
    distance[v] = 0;
    for (int k = 1; k <= 3; ++k)
      for (Index w : walker.ring(k)) distance[w] = k;
    for (int k = 1; k <= 4; ++k) {
      const std::set<Index> faces(walker.faces(k).begin(), walker.faces(k).end());
      CHECK(faces.size() == walker.faces(k).size());
      for (Index f = 0; f < m.face_count(); ++f) {
        const auto [a, b, c] = m.view().face(f);
        CHECK((std::min({distance[a], distance[b], distance[c]}) <= k - 1) == (faces.count(f) == 1));
      }
    }
  }
}

TEST_CASE("walks stay on their component and survive isolated vertices") {
  Soup s = joined(plane(3, 3), plane(3, 3));  // two sheets in the same place
  add_vertex(s, Vec3(5, 5, 5));
  const Mesh m = raw_mesh(s);
  RingWalker walker(m);
  walker.walk(0, 6);
  for (Index w : walker.vertices(6)) CHECK(w < 16);
  CHECK(walker.vertices(6).size() == 15);
  CHECK(walker.depth() < 6);
  walker.walk(32, 6);
  walker.collect_faces(6);
  CHECK(walker.depth() == 0);
  CHECK(walker.vertices(6).empty());
  CHECK(walker.faces(6).empty());
}

TEST_CASE("the cap keeps whole rings, but cuts ring 1") {
  Soup fan;  // a pole with 100 neighbours and a second row of 100
  add_vertex(fan, Vec3::Zero());
  for (int row = 1; row <= 2; ++row)
    for (int i = 0; i < 100; ++i) add_vertex(fan, row * Vec3(std::cos(i * 0.0628318), std::sin(i * 0.0628318), 0));
  for (Index i = 0; i < 100; ++i) {
    const Index j = (i + 1) % 100;
    add_face(fan, 0, 1 + i, 1 + j);
    add_face(fan, 1 + i, 101 + i, 101 + j), add_face(fan, 1 + i, 101 + j, 1 + j);
  }
  const Mesh m = raw_mesh(fan);
  RingWalker walker(m);
  walker.walk(0, 2, 150);
  CHECK(walker.depth() == 1);
  CHECK(walker.vertices(2).size() == 100);
  walker.extend(2, 1000);
  CHECK(walker.depth() == 1);
  walker.walk(0, 2, 200);
  CHECK(walker.vertices(2).size() == 200);
  walker.walk(0, 2, 40);
  CHECK(walker.vertices(2).size() == 40);
}

TEST_CASE("a line of barrier edges is reached but not crossed") {
  const Mesh m = raw_mesh(plane(8, 8));
  std::vector<std::uint8_t> barrier(m.edge_count(), 0);
  for (Index e = 0; e < m.edge_count(); ++e) barrier[e] = m.x[m.edge_v0[e]] == 0.5 && m.x[m.edge_v1[e]] == 0.5;
  RingWalker walker(m, barrier);
  walker.walk(nearest_vertex(m, Vec3(0.25, 0.5, 0)), 6);
  bool reached = false;
  for (Index w : walker.vertices(6)) {
    CHECK(m.x[w] <= 0.5);
    reached = reached || m.x[w] == 0.5;
  }
  CHECK(reached);
  walker.walk(nearest_vertex(m, Vec3(0.5, 0.5, 0)), 1);
  CHECK(walker.vertices(1).size() == 6);
}
