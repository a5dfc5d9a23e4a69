#include "kernels/quality/surface_distance.h"

#include <cmath>

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "engine/space/point_triangle.h"
#include "tests/support/run_with_threads.h"
#include "tests/support/shapes.h"

using namespace intarsia;
using namespace intarsia::kernels;
using doctest::Approx;

namespace {

TrianglesView view_of(const Soup& s) { return {{s.x, s.y, s.z}, s.corner}; }

SurfaceDistance between(const Soup& a, const Soup& b, DistanceOptions options = {.samples = 40'000}) {
  return surface_distance(Work(), view_of(a), view_of(b), options);
}

// Square of the given side around the z axis, `cells` x `cells` x 2 triangles.
Soup square(Real side, Index cells, Real z) {
  Soup s;
  for (Index j = 0; j <= cells; ++j)
    for (Index i = 0; i <= cells; ++i)
      test::add_vertex(s, {side * (i / Real(cells) - 0.5), side * (j / Real(cells) - 0.5), z});
  for (Index j = 0; j < cells; ++j)
    for (Index i = 0; i < cells; ++i) {
      const Index a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1;
      test::add_face(s, a, b, c + 1), test::add_face(s, a, c + 1, c);
    }
  return s;
}

Soup cube(Real half) {
  Soup s;
  for (Index i = 0; i < 8; ++i) test::add_vertex(s, half * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  for (const auto& f :
       {std::array<Index, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    test::add_face(s, f[0], f[1], f[2]), test::add_face(s, f[0], f[2], f[3]);
  return s;
}

Soup random_soup(Index n, std::uint64_t seed) {
  const Random random(seed, 5);
  Soup s;
  for (Index t = 0; t < n; ++t) {
    for (Index i = 0; i < 3; ++i) {
      const std::uint64_t key = 3 * std::uint64_t{t} + i;
      test::add_vertex(s, {random.uniform(key, 0), random.uniform(key, 1), random.uniform(key, 2)});
    }
    if (t % 5 == 4)
      test::add_face(s, 3 * t, 3 * t + 1, 3 * t + 1);  // a segment
    else
      test::add_face(s, 3 * t, 3 * t + 1, 3 * t + 2);
  }
  return s;
}

Real distance_to_all(const Soup& s, const Vec3& p) {
  Real best = 1e300;
  for (Index t = 0; t < s.face_count(); ++t) {
    const auto corner = [&](Index i) { return test::point(s, s.corner[3 * t + i]); };
    best = std::min(best, (p - closest_on_triangle(p, corner(0), corner(1), corner(2))).norm());
  }
  return best;
}

}  // namespace

TEST_CASE("equal surfaces are nowhere apart, whatever their triangles and their order") {
  const Soup sphere = test::icosphere(3);
  const SurfaceDistance d = between(sphere, test::shuffle(sphere, 5));
  CHECK(d.hausdorff() < 1e-15);
  CHECK(d.forward.bound < 1e-12);
  CHECK(d.rms() < 1e-15);
  const SurfaceDistance flat = between(square(1, 1, 0), square(1, 7, 0));
  CHECK(flat.hausdorff() < 1e-15);
  CHECK(flat.backward.bound < 1e-12);
}

TEST_CASE("parallel unit squares are as far apart as their planes") {
  for (const Index cells : {1u, 6u}) {
    const SurfaceDistance d = between(square(1, cells, 0), square(1, 5, 0.3));
    for (const OneSided& side : {d.forward, d.backward}) {
      CHECK(side.max == Approx(0.3).epsilon(1e-12));
      CHECK(side.bound == Approx(0.3).epsilon(1.001e-3));
      CHECK(side.mean == Approx(0.3).epsilon(1e-12));
      CHECK(side.rms == Approx(0.3).epsilon(1e-12));
      CHECK(side.area == Approx(1));
    }
  }
}

TEST_CASE("unit square against the concentric square of side two") {
  const SurfaceDistance d = between(square(1, 3, 0), square(2, 2, 0), {.samples = 400'000});
  CHECK(d.forward.max < 1e-15);
  CHECK(d.backward.max == Approx(std::sqrt(0.5)).epsilon(1e-12));  // at the corners
  CHECK(d.backward.rms == Approx(1 / std::sqrt(12)).epsilon(1e-4));
  // Sides: 4 strips of area 1/2 at mean 1/4; corners: 4 squares of area 1/4 at mean distance of a square's corner.
  const Real corner = 0.5 * (std::sqrt(2) + std::log(1 + std::sqrt(2))) / 3;
  CHECK(d.backward.mean == Approx((4 * 0.5 * 0.25 + 4 * 0.25 * corner) / 4).epsilon(1e-4));
  CHECK(std::abs(d.backward.worst.x()) == 1);
  CHECK(d.hausdorff() == d.backward.max);
  for (const Real v : d.vertex_distance) CHECK(v < 1e-15);
}

TEST_CASE("a fine sphere against a cube: corners are farthest one way, poles the other") {
  const Soup sphere = test::icosphere(5), box = cube(1);
  const SurfaceDistance d = between(box, sphere, {.samples = 200'000});
  CHECK(d.forward.max == Approx(std::sqrt(3) - 1).epsilon(1e-3));
  CHECK(d.forward.bound >= d.forward.max);
  // A point of the sphere is farthest from the cube around it where all three coordinates are equal.
  CHECK(d.backward.max == Approx(1 - 1 / std::sqrt(3)).epsilon(2e-3));
  CHECK(std::abs(d.backward.worst.x()) == Approx(1 / std::sqrt(3)).epsilon(0.05));
}

TEST_CASE("an icosphere of 1280 faces against a much finer one: the largest sagitta of its faces") {
  const SurfaceDistance d = between(test::icosphere(3), test::icosphere(6), {.samples = 60'000});
  CHECK(d.forward.max == Approx(0.004528).epsilon(0.02));  // to the sphere itself; 1e-4 less here
  CHECK(d.forward.bound >= d.forward.max);
}

TEST_CASE("a convex body moved by t is t apart at most, and in some direction exactly") {
  const Soup box = cube(0.5);
  const Vec3 t(0.02, 0.01, -0.03);
  const SurfaceDistance d = between(box, test::transformed(box, [&](const Vec3& p) { return p + t; }));
  CHECK(d.hausdorff() <= t.norm() * (1 + 1e-12));
  const Vec3 along(0.05, 0.05, 0.05);
  const SurfaceDistance e = between(box, test::transformed(box, [&](const Vec3& p) { return p + along; }));
  CHECK(e.hausdorff() == Approx(along.norm()).epsilon(1e-12));
}

TEST_CASE("samples and vertices agree with looking at all triangles, segments among them") {
  const Soup a = random_soup(60, 1), b = random_soup(80, 2);
  const SurfaceDistance d = between(a, b, {.samples = 3000, .per_sample = true});
  REQUIRE(d.forward_sample.distance.size() == d.forward.samples);
  CHECK(d.forward.samples >= 1480);
  Real most = 0;
  for (std::size_t i = 0; i < d.forward_sample.distance.size(); ++i) {
    const Real expected = distance_to_all(b, d.forward_sample.point[i]);
    CHECK(d.forward_sample.distance[i] == Approx(expected).epsilon(1e-14));
    most = std::max(most, expected);
  }
  for (Index v = 0; v < a.vertex_count(); ++v) {
    const bool used = v % 15 != 14;
    CHECK(d.vertex_distance[v] == Approx(used ? distance_to_all(b, test::point(a, v)) : 0).epsilon(1e-14));
    most = std::max(most, d.vertex_distance[v]);
  }
  CHECK(d.forward.max >= most);
  CHECK(distance_to_all(b, d.forward.worst) == Approx(d.forward.max).epsilon(1e-14));
  // Nothing on a finer net of points lies beyond the proven bound.
  for (Index t = 0; t < a.face_count(); ++t)
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; i + j <= 20; ++j) {
        const Vec3 p = test::point(a, a.corner[3 * t]) * (1 - (i + j) / 20.0) +
                       test::point(a, a.corner[3 * t + 1]) * (i / 20.0) +
                       test::point(a, a.corner[3 * t + 2]) * (j / 20.0);
        if (!(distance_to_all(b, p) <= d.forward.bound * (1 + 1e-12))) FAIL("beyond the bound");
      }
  CHECK(d.forward.bound <= d.forward.max * 1.0011);
}

TEST_CASE("the largest distance is found where no sample lies") {
  // A thin spike in the middle of one big triangle: few samples see the hole that the other surface has there.
  Soup plate = square(2, 1, 0), holed = square(2, 40, 0);
  std::vector<Index> kept;
  for (std::size_t f = 0; f < holed.face_count(); ++f) {
    Vec3 centre = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) centre += test::point(holed, holed.corner[3 * f + i]) / 3;
    if (std::abs(centre.x() - 0.3) < 0.05 && std::abs(centre.y() - 0.2) < 0.05) continue;
    for (std::size_t i = 0; i < 3; ++i) kept.push_back(holed.corner[3 * f + i]);
  }
  holed.corner = kept;
  const SurfaceDistance d = between(plate, holed, {.samples = 20});
  CHECK(d.forward.max == Approx(0.05).epsilon(1.001e-3));  // the middle of a hole of side 0.1
  CHECK(d.forward.bound == Approx(0.05).epsilon(1.1e-3));
}

TEST_CASE("sampling converges at least as one over the square root of the number") {
  const Soup a = test::icosphere(1), b = cube(0.8);
  const Real truth = between(a, b, {.samples = 4'000'000}).rms();
  for (const std::uint64_t n : {2'000u, 32'000u, 512'000u}) {
    const Real error = std::abs(between(a, b, {.samples = n}).rms() - truth) / truth;
    CHECK(error < 0.5 / std::sqrt(static_cast<Real>(n)));
  }
}

TEST_CASE("sums over labels add up to the whole") {
  const Soup a = test::icosphere(3), b = cube(0.7);
  const SurfaceDistance d = between(a, b);
  std::vector<Index> label(a.face_count());
  for (Index f = 0; f < a.face_count(); ++f) label[f] = f % 3;
  Real area = 0, mean = 0, square2 = 0, most = 0;
  for (const PartDistance& p : distance_per_label(d, label, 3))
    area += p.area, mean += p.area * p.mean, square2 += p.area * p.rms * p.rms, most = std::max(most, p.max);
  CHECK(area == Approx(d.forward.area));
  CHECK(mean / area == Approx(d.forward.mean));
  CHECK(std::sqrt(square2 / area) == Approx(d.forward.rms));
  CHECK(most == d.forward.max);
}

TEST_CASE("any number of threads gives the same bits") {
  const Soup a = test::icosphere(5), b = test::scaled(test::shuffle(test::icosphere(4), 3), 1.01);
  const auto run = [&] { return between(a, b, {.samples = 100'000, .per_sample = true}); };
  const SurfaceDistance one = test::run_with_threads(1, run);
  for (const int threads : {2, 5}) {
    const SurfaceDistance many = test::run_with_threads(threads, run);
    for (const auto& [x, y] : {std::pair(one.forward, many.forward), std::pair(one.backward, many.backward)}) {
      CHECK(x.max == y.max);
      CHECK(x.bound == y.bound);
      CHECK(x.mean == y.mean);
      CHECK(x.rms == y.rms);
      CHECK(x.worst == y.worst);
      CHECK(x.samples == y.samples);
    }
    CHECK(one.face_rms == many.face_rms);
    CHECK(one.vertex_distance == many.vertex_distance);
    CHECK(one.forward_sample.distance == many.forward_sample.distance);
  }
}

TEST_CASE("a surface without area is refused") {
  Soup line;
  for (int i = 0; i < 3; ++i) test::add_vertex(line, Vec3(i, 0, 0));
  test::add_face(line, 0, 1, 2);
  CHECK_THROWS_AS(between(line, cube(1)), Error);
  CHECK_THROWS_AS(between(cube(1), line), Error);
}
