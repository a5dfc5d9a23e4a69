#include "kernels/surface/split_long_edges.h"

#include <cmath>

#include <doctest/doctest.h>

#include "kernels/surface/diagnose_soup.h"
#include "tests/support/shapes.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

Real area_of(const Soup& s, Index t) {
  const Vec3 a = test::point(s, s.corner[3 * t]);
  return (test::point(s, s.corner[3 * t + 1]) - a).cross(test::point(s, s.corner[3 * t + 2]) - a).norm() / 2;
}

// A bar of 12 triangles, 10 x 1 x 1.
Soup bar() {
  return transformed(cube(1), [](const Vec3& p) { return Vec3(10 * p.x(), p.y(), p.z()); });
}

// A tube whose triangles are as long as itself.
Soup long_tube() { return cylinder(1, 1, 20, 40, 1); }

}  // namespace

TEST_CASE("variation of edge lengths") {
  CHECK(edge_variation({}, icosphere(0)) < 1e-7);
  // right triangles with sides 1, 1, sqrt 2
  const Real mean = (2 + std::sqrt(2.0)) / 3, square = 4.0 / 3;
  CHECK(edge_variation({}, plane(5, 5)) == doctest::Approx(std::sqrt(square - mean * mean) / mean));
  CHECK(edge_variation({}, bar()) > 0.5);
  CHECK(edge_variation({}, long_tube()) > 0.6);
}

TEST_CASE("no edge is left too long, planes, areas and topology stay") {
  for (const Soup& soup : {bar(), long_tube(), plane(2, 2), joined(cube(1), long_tube())}) {
    const SoupDiagnosis before = diagnose_soup({}, soup);
    for (const Real length : {3.0, 0.7, 0.15}) {
      CAPTURE(length);
      const SplitSoup split = split_long_edges({}, soup, length);
      const SoupDiagnosis d = diagnose_soup({}, split.soup);
      CHECK(d.is_surface());
      CHECK(d.edge_most <= length);
      CHECK(d.components == before.components);
      CHECK(d.border_loops == before.border_loops);
      CHECK(d.genus == before.genus);
      REQUIRE(split.parent.size() == split.soup.face_count());
      std::vector<Real> area(soup.face_count(), 0);
      for (Index t = 0; t < split.soup.face_count(); ++t) {
        const Index parent = split.parent[t];
        area[parent] += area_of(split.soup, t);
        const Vec3 a = test::point(soup, soup.corner[3 * parent]);
        const Vec3 n = (test::point(soup, soup.corner[3 * parent + 1]) - a)
                           .cross(test::point(soup, soup.corner[3 * parent + 2]) - a)
                           .normalized();
        for (int i = 0; i < 3; ++i)
          CHECK(std::abs(n.dot(test::point(split.soup, split.soup.corner[3 * t + i]) - a)) < 1e-12);
      }
      for (Index t = 0; t < soup.face_count(); ++t) CHECK(area[t] == doctest::Approx(area_of(soup, t)));
      for (Index v = 0; v < soup.vertex_count(); ++v) CHECK(split.soup.x[v] == soup.x[v]);
    }
  }
}

TEST_CASE("short edges stay as they are") {
  const Soup soup = icosphere(2);
  const SplitSoup split = split_long_edges({}, soup, 2);
  CHECK(split.soup.corner == soup.corner);
  CHECK(split.soup.x == soup.x);
}

TEST_CASE("a box of twelve triangles is polyhedral, spheres and fine boxes are not") {
  CHECK(is_polyhedral(Work(), test::cube(1), {}));
  CHECK(is_polyhedral(Work(), test::cube(5), {}));
  CHECK(!is_polyhedral(Work(), test::cube(12), {}));  // fine enough as it is
  CHECK(!is_polyhedral(Work(), test::icosphere(2), {}));
  CHECK(!is_polyhedral(Work(), test::icosphere(3), {}));
  CHECK(!is_polyhedral(Work(), test::plane(4, 4), {}));
  CHECK(!is_polyhedral(Work(), test::cylinder(1, 1, 3, 24, 6), {}));
}

TEST_CASE("two triangles back to back are a pillow") {
  Soup s;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(5, 0, 0), Vec3(0, 5, 0)}) add_vertex(s, p);
  add_face(s, 0, 1, 2);
  CHECK(!has_pillows(Work(), s));
  add_face(s, 0, 2, 1);
  CHECK(has_pillows(Work(), s));
  CHECK(!has_pillows(Work(), test::cube(2)));
}
