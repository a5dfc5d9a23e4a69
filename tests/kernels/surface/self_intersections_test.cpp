#include "kernels/surface/self_intersections.h"

#include <doctest/doctest.h>

#include "tests/support/run_with_threads.h"
#include "tests/support/shapes.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

Soup triangles(const std::vector<std::array<Vec3, 3>>& list) {
  Soup s;
  for (const auto& t : list) {
    const Index a = add_vertex(s, t[0]), b = add_vertex(s, t[1]), c = add_vertex(s, t[2]);
    add_face(s, a, b, c);
  }
  return s;
}

std::uint64_t pairs(const std::vector<std::array<Vec3, 3>>& list) {
  return self_intersections(Work(), triangles(list)).pairs;
}

Soup moved(const Soup& s, const Vec3& by) {
  return transformed(s, [&](const Vec3& p) { return Vec3(p + by); });
}

}  // namespace

TEST_CASE("two triangles: every way to meet or not to") {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  CHECK(pairs({{a, b, c}, {Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(9, 9, 0)}}) == 1);  // pierced
  CHECK(pairs({{a, b, c}, {Vec3(1, 1, 1), Vec3(2, 1, 1), Vec3(1, 2, 1)}}) == 0);   // above
  CHECK(pairs({{a, b, c}, {Vec3(1, 1, 0), Vec3(2, 1, 1), Vec3(1, 2, 1)}}) == 1);   // touched by a corner
  CHECK(pairs({{a, b, c}, {Vec3(1, 1, 0), Vec3(2, 1, 0), Vec3(1, 2, 0)}}) == 1);   // inside, in one plane
  CHECK(pairs({{a, b, c}, {Vec3(5, 5, 0), Vec3(6, 5, 0), Vec3(5, 6, 0)}}) == 0);   // beside, in one plane
  CHECK(pairs({{a, b, c}, {b, a, Vec3(2, -3, 0)}}) == 0);                          // neighbours, flat
  CHECK(pairs({{a, b, c}, {b, a, Vec3(2, 1, 3)}}) == 0);                           // neighbours, bent
  CHECK(pairs({{a, b, c}, {b, a, Vec3(2, 3, 0)}}) == 1);                           // folded onto each other
  CHECK(pairs({{a, b, c}, {a, Vec3(-4, 0, 0), Vec3(0, -4, 0)}}) == 0);             // a common corner
  CHECK(pairs({{a, b, c}, {a, Vec3(-3, 3, -1), Vec3(-3, 3, 1)}}) == 0);            // a common corner, elsewhere
  CHECK(pairs({{a, b, c}, {a, Vec3(3, 3, -1), Vec3(3, 3, 1)}}) == 1);              // a common corner, along the inside
  CHECK(pairs({{a, b, c}, {a, Vec3(1, 1, -1), Vec3(1, 1, 1)}}) == 1);              // a common corner, pierced
  CHECK(pairs({{a, b, c}, {Vec3(1, 0, 0), Vec3(3, 0, 0), Vec3(2, -2, 0)}}) == 1);  // along a part of an edge
  CHECK(pairs({{a, b, c}, {a, b, c}}) == 0);                                       // repeated: another fault
  CHECK(pairs({{a, b, c}, {Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(1, 1, 2)}}) == 0);  // no area
}

TEST_CASE("closed surfaces have none, whatever their size and place") {
  for (const Real scale : {1e-9, 1.0, 1e12}) {
    CHECK(self_intersections(Work(), scaled(icosphere(4), scale)).pairs == 0);
    CHECK(self_intersections(Work(), scaled(cube(9), scale)).pairs == 0);
  }
  CHECK(self_intersections(Work(), moved(torus(2, 0.7, 90, 40), {1e5, -3e4, 7})).pairs == 0);
}

TEST_CASE("two spheres through each other: the same pairs by the tree and by trying all") {
  const Soup one = icosphere(3), two = moved(icosphere(3), {0.7, 0.31, 0.17}), both = joined(one, two);
  const SelfIntersections found = self_intersections(Work(), both);
  std::uint64_t tried = 0;
  const auto corners = [](const Soup& s, Index f) {
    return std::array<Vec3, 3>{point(s, s.corner[3 * f]), point(s, s.corner[3 * f + 1]), point(s, s.corner[3 * f + 2])};
  };
  for (Index f = 0; f < one.face_count(); ++f)
    for (Index g = 0; g < two.face_count(); ++g) {
      const auto s = corners(one, f), t = corners(two, g);
      if ((s[0] - t[0]).norm() < 0.8) tried += pairs({s, t});
    }
  CHECK(found.pairs == tried);
  CHECK(found.pairs > 50);
  CHECK(found.triangles.count > 50);
  CHECK(found.triangles.first.size() == Fault::kNamed);
  const SelfIntersections again = run_with_threads(3, [&] { return self_intersections(Work(), both); });
  CHECK(again.pairs == found.pairs);
  CHECK(again.triangles.first == found.triangles.first);
}
