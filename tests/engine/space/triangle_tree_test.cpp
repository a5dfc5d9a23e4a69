#include "engine/space/triangle_tree.h"

#include <cmath>

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "engine/space/point_triangle.h"
#include "tests/support/run_with_threads.h"
#include "tests/support/shapes.h"

using namespace intarsia;

namespace {

TrianglesView view_of(const Soup& s) { return {{s.x, s.y, s.z}, s.corner}; }

Vec3 random_point(const Random& random, std::uint64_t i, Real scale) {
  return scale * Vec3(2 * random.uniform(i, 0) - 1, 2 * random.uniform(i, 1) - 1, 2 * random.uniform(i, 2) - 1);
}

// Triangles of all sizes, some on a coarse lattice (equal distances), every seventh a segment, every eleventh a point,
// some of them several times.
Soup random_triangles(Index n, Real scale) {
  const Random random(11, 3);
  Soup s;
  for (Index t = 0; t < n; ++t) {
    const Vec3 centre = random_point(random, 4 * std::uint64_t{t}, scale);
    const Real size = scale * std::exp(-8 * random.uniform(t, 7));
    for (Index i = 0; i < 3; ++i) {
      Vec3 p = centre + random_point(random, 4 * std::uint64_t{t} + 1 + i, size);
      if (t % 3 == 0) p = (8 / scale * p).array().round() * (scale / 8);
      if ((t % 7 == 0 && i == 2) || (t % 11 == 0 && i > 0)) p = intarsia::test::point(s, 3 * t + i - 1);
      intarsia::test::add_vertex(s, p);
    }
    const Index from = t % 13 == 12 ? t - 1 : t;
    intarsia::test::add_face(s, 3 * from, 3 * from + 1, 3 * from + 2);
  }
  return s;
}

ClosestTriangle look_at_all(const Soup& s, const Vec3& p) {
  ClosestTriangle best;
  best.distance2 = std::numeric_limits<Real>::infinity();
  for (Index t = 0; t < s.face_count(); ++t) {
    const auto corner = [&](Index i) { return intarsia::test::point(s, s.corner[3 * t + i]); };
    const Vec3 q = closest_on_triangle(p, corner(0), corner(1), corner(2));
    const Real d2 = (p - q).squaredNorm();
    if (d2 < best.distance2) best = {t, d2, q};
  }
  return best;
}

void check_same(const ClosestTriangle& a, const ClosestTriangle& b) {
  CHECK(a.triangle == b.triangle);
  CHECK(a.distance2 == b.distance2);
  CHECK(a.point == b.point);
}

}  // namespace

TEST_CASE("closest triangles are those of looking at all, bit by bit, with any hint") {
  for (const Real scale : {1.0, 1e-7, 1e6})
    for (const Index n : {1u, 2u, 9u, 100u, 3000u}) {
      const Soup s = random_triangles(n, scale);
      const TriangleTree tree(Work(), view_of(s));
      const Random random(12, n);
      for (Index i = 0; i < 300; ++i) {
        Vec3 p = random_point(random, i, 1.5 * scale);
        if (i % 3 == 0) p = (8 / scale * p).array().round() * (scale / 8);
        if (i % 5 == 0) p = intarsia::test::point(s, i % s.vertex_count());
        if (i % 50 == 0) p *= 1e5;
        const ClosestTriangle expected = look_at_all(s, p);
        check_same(tree.closest(p), expected);
        check_same(tree.closest(p, i % n), expected);
        check_same(tree.closest(p, expected.triangle), expected);
      }
    }
}

TEST_CASE("far from the origin boxes still hold what rounding makes of their triangles") {
  const Vec3 offset(1e8, -3e7, 2e8);
  const Soup s = intarsia::test::transformed(random_triangles(500, 1.0), [&](const Vec3& p) { return p + offset; });
  const TriangleTree tree(Work(), view_of(s));
  const Random random(13, 0);
  for (Index i = 0; i < 500; ++i) {
    const Vec3 p = offset + random_point(random, i, 1.2);
    check_same(tree.closest(p), look_at_all(s, p));
  }
}

TEST_CASE("many equal triangles and triangles in one place make a tree of bounded depth") {
  Soup s;
  for (Index t = 0; t < 5000; ++t) {
    // Centres that halve their distance each time: no even split by place.
    const Vec3 p(t < 1000 ? std::pow(0.5, t) : 0, 0, 0);
    for (const Vec3& d : {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) intarsia::test::add_vertex(s, p + d);
    intarsia::test::add_face(s, 3 * t, 3 * t + 1, 3 * t + 2);
  }
  const TriangleTree tree(Work(), view_of(s));
  const ClosestTriangle found = tree.closest(Vec3(-1, 0.2, 0.2));
  check_same(found, look_at_all(s, Vec3(-1, 0.2, 0.2)));
  CHECK(found.distance2 == doctest::Approx(1));
}

TEST_CASE("the first hit of a ray is the nearest beyond the least distance") {
  const Soup sphere = intarsia::test::icosphere(3);
  const TriangleTree tree(Work(), view_of(sphere));
  const Random random(14, 1);
  for (Index i = 0; i < 300; ++i) {
    const Vec3 direction = random_point(random, i, 1).normalized();
    const Real near = tree.first_hit(Vec3::Zero(), direction, 0);
    CHECK(near > 1 - 0.0046);  // the largest sagitta of the faces
    CHECK(near <= 1 + 1e-12);
    const Real entry = tree.first_hit(-2 * direction, direction, 0);
    CHECK(entry < 1.0046);
    CHECK(tree.first_hit(-2 * direction, direction, entry + 1e-6) == doctest::Approx(2 + near));
    CHECK(std::isinf(tree.first_hit(2 * direction, direction, 0)));
  }
  // Axis-parallel rays in axis-parallel planes.
  Soup square;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}) test::add_vertex(square, p);
  test::add_face(square, 0, 1, 2), test::add_face(square, 0, 2, 3);
  const TriangleTree flat(Work(), view_of(square));
  CHECK(flat.first_hit(Vec3(0.25, 0.5, 3), -Vec3::UnitZ(), 0) == 3);
  CHECK(flat.first_hit(Vec3(0, 0, 3), -Vec3::UnitZ(), 0) == 3);
  CHECK(std::isinf(flat.first_hit(Vec3(1.25, 0.5, 3), -Vec3::UnitZ(), 0)));
  CHECK(std::isinf(flat.first_hit(Vec3(0.25, 0.5, 3), Vec3::UnitZ(), 0)));
  CHECK(std::isinf(flat.first_hit(Vec3(-1, 0.5, 0), Vec3::UnitX(), 0)));  // in the plane
}

TEST_CASE("a tree of no triangle is refused") {
  const Soup none;
  CHECK_THROWS_AS(TriangleTree(Work(), view_of(none)), Error);
}
