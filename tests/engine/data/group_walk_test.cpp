#include "engine/data/group_walk.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "engine/data/k_ring.h"
#include "tests/support/raw_mesh.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

constexpr Index kAll = 1 << 20;  // a cap that nothing reaches

// Every source of every group against its own walk.
void check_against_single_walks(const MeshView& m, int rings, Index group = GroupWalker::kGroup,
                                std::span<const std::uint8_t> barrier = {}) {
  GroupWalker together(m, barrier);
  RingWalker alone(m, barrier);
  for (Index first = 0; first < m.vertex_count(); first += group) {
    const Index count = std::min(group, m.vertex_count() - first);
    REQUIRE(together.walk(first, count, rings));
    together.collect_faces(rings + 1);
    for (Index b = 0; b < count; ++b) {
      CHECK(together.vertices(0)[b] == first + b);
      alone.walk(first + b, rings, kAll);
      alone.collect_faces(rings + 1);
      for (int k = 0; k <= rings; ++k) {
        CAPTURE(first + b);
        CAPTURE(k);
        std::vector<Index> met, expected(alone.vertices(k).begin(), alone.vertices(k).end());
        expected.push_back(first + b);
        std::sort(expected.begin(), expected.end());
        for (std::size_t i = 0; i < together.within(k).size(); ++i)
          if (together.within(k)[i] >> b & 1) met.push_back(together.vertices(k)[i]);
        std::sort(met.begin(), met.end());
        CHECK(met == expected);
        std::vector<Index> faces, fan(alone.faces(k + 1).begin(), alone.faces(k + 1).end());
        std::sort(fan.begin(), fan.end());
        const auto mask = together.face_within(k + 1);
        REQUIRE(mask.size() == together.faces(k + 1).size());
        for (std::size_t i = 0; i < mask.size(); ++i)
          if (mask[i] >> b & 1) faces.push_back(together.faces(k + 1)[i]);
        std::sort(faces.begin(), faces.end());
        CHECK(faces == fan);
      }
    }
    // Nothing is listed twice, nothing that no source reaches, prefixes are prefixes.
    for (int k = 0; k <= rings; ++k) {
      const auto list = together.vertices(k);
      CHECK(std::set<Index>(list.begin(), list.end()).size() == list.size());
      CHECK(list.data() == together.vertices(0).data());
      for (GroupWalker::Mask w : together.within(k)) CHECK(w != 0);
      const auto faces = together.faces(k + 1);
      CHECK(std::set<Index>(faces.begin(), faces.end()).size() == faces.size());
      for (GroupWalker::Mask w : together.face_within(k + 1)) CHECK(w != 0);
    }
    const auto places = together.face_places();
    const auto all = together.vertices(rings);
    REQUIRE(places.size() == together.faces(rings + 1).size());
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const Index corner = m.corner[3 * together.faces(rings + 1)[i] + c];
        if (places[i][c] < all.size())
          CHECK(all[places[i][c]] == corner);
        else
          CHECK(std::find(all.begin(), all.end(), corner) == all.end());
      }
  }
}

Soup wheel(Index spokes, int rows) {  // a pole with rows of as many neighbours around it
  Soup s;
  add_vertex(s, Vec3::Zero());
  for (int row = 1; row <= rows; ++row)
    for (Index i = 0; i < spokes; ++i) {
      const Real angle = 6.283185307179586 * i / spokes;
      add_vertex(s, row * Vec3(std::cos(angle), std::sin(angle), 0));
    }
  for (Index i = 0; i < spokes; ++i) {
    const Index j = (i + 1) % spokes;
    add_face(s, 0, 1 + i, 1 + j);
    for (Index row = 0; row + 1 < static_cast<Index>(rows); ++row) {
      const Index a = 1 + row * spokes + i, b = 1 + row * spokes + j;
      add_face(s, a, a + spokes, b + spokes), add_face(s, a, b + spokes, b);
    }
  }
  return s;
}

}  // namespace

TEST_CASE("group walks on closed, bordered and high-valence meshes") {
  check_against_single_walks(raw_mesh(shuffle(icosphere(3), 3)), 5);
  check_against_single_walks(raw_mesh(plane(17, 13, Diagonals::alternating)), 5);
  check_against_single_walks(raw_mesh(plane(17, 13)), 3, 16);
  check_against_single_walks(raw_mesh(wheel(40, 5)), 4);
  check_against_single_walks(raw_mesh(wheel(9, 12)), 7, 7);
}

TEST_CASE("group walks stay on their component and survive isolated vertices") {
  Soup s = joined(joined(icosphere(1), plane(3, 3)), plane(3, 3));
  add_vertex(s, Vec3(5, 5, 5));
  add_vertex(s, Vec3(5, 5, 6));
  check_against_single_walks(raw_mesh(s), 5);
  check_against_single_walks(raw_mesh(s), 0);
}

TEST_CASE("group walks where several fans meet in one vertex") {
  Soup s = plane(6, 6);
  const Soup other = transformed(plane(5, 5), [](const Vec3& p) { return Vec3(p.x(), p.y(), 1); });
  const Index shift = s.vertex_count();
  s = joined(s, other);
  for (Index& c : s.corner)
    if (c == shift + 14) c = 24;  // an inner vertex of one sheet becomes an inner vertex of the other
  check_against_single_walks(raw_mesh(s), 5);
}

TEST_CASE("group walks do not cross barriers") {
  const Mesh m = raw_mesh(jittered(plane(14, 14, Diagonals::alternating), 0.001, 4));
  const Random random(7, 1);
  for (Real share : {0.02, 0.1, 0.4}) {
    std::vector<std::uint8_t> barrier(m.edge_count());
    for (Index e = 0; e < m.edge_count(); ++e) barrier[e] = random.uniform(e) < share;
    check_against_single_walks(m, 5, 64, barrier);
    check_against_single_walks(m, 4, 10, barrier);
  }
  const Mesh pole = raw_mesh(wheel(30, 5));
  std::vector<std::uint8_t> barrier(pole.edge_count());
  for (Index e = 0; e < pole.edge_count(); ++e) barrier[e] = random.uniform(e) < 0.05;
  check_against_single_walks(pole, 5, 64, barrier);
}

TEST_CASE("a walk that meets too much says so, and the next one is not harmed") {
  const Mesh m = raw_mesh(wheel(300, 3));
  GroupWalker walker(m);
  CHECK_FALSE(walker.walk(0, 64, 3, 500));
  CHECK(walker.walk(0, 64, 3, 901));
  CHECK(walker.vertices(3).size() == 901);
  CHECK_FALSE(walker.walk(5, 1, 3, 500));
  REQUIRE(walker.walk(700, 10, 1, 500));
  RingWalker alone(m);
  alone.walk(703, 1);
  std::vector<Index> met;
  for (std::size_t i = 0; i < walker.within(1).size(); ++i)
    if (walker.within(1)[i] >> 3 & 1) met.push_back(walker.vertices(1)[i]);
  std::sort(met.begin(), met.end());
  std::vector<Index> expected(alone.vertices(1).begin(), alone.vertices(1).end());
  expected.push_back(703);
  std::sort(expected.begin(), expected.end());
  CHECK(met == expected);
}
