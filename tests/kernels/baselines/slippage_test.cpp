#include "kernels/baselines/slippage.h"

#include <array>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "kernels/baselines/slippage_segments.h"
#include "tests/support/baseline_checks.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;

namespace {

constexpr Real kPi = std::numbers::pi;

SlippageSums sums_of(const FaceGraph& g) {
  SlippageSums s;
  for (Index f = 0; f < g.faces(); ++f) s.add(g.area[f], g.centroid[f], g.normal[f]);
  return s;
}

template <class Position>
FaceGraph sheet(const Position& position) {
  return test::face_graph(test::grid(120, 120, false, false, test::Diagonals::alternating, position));
}
FaceGraph strip(Real degrees, Real height) {
  return sheet([&](Real u, Real v) {
    const Real a = degrees * kPi / 180 * u;
    return Vec3(std::cos(a), std::sin(a), height * v);
  });
}
FaceGraph sphere_cap(Real degrees) {
  return sheet([&](Real u, Real v) {
    const Real a = 2 * kPi * u, b = degrees * kPi / 180 * (1 - v);
    return Vec3(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b));
  });
}

void check_values(const FaceGraph& g, const std::array<Real, 6>& expected, int dimension) {
  const Slippage s = slippage_of(sums_of(g));
  for (int i = 0; i < 6; ++i) {
    CAPTURE(i);
    CHECK(s.value[i] == doctest::Approx(expected[static_cast<std::size_t>(i)]).epsilon(0.02).scale(0.5));
  }
  CHECK(s.dimension() == dimension);
}

}  // namespace

TEST_CASE("a plane slips three ways, with the values of its moments") {
  // Uniform on a square, root mean square radius 1: the two tilts have 1/2 each, the lift 1.
  check_values(sheet([](Real u, Real v) { return Vec3(u, v, 0); }), {0, 0, 0, 0.5, 0.5, 1}, 3);
}

TEST_CASE("a whole sphere slips in every rotation; translations are alike") {
  check_values(test::face_graph(test::icosphere(5)), {0, 0, 0, 1.0 / 3, 1.0 / 3, 1.0 / 3}, 3);
  CHECK(slippage_of(sums_of(sphere_cap(60))).dimension() == 3);
}

TEST_CASE("a cylinder slips two ways, whole and as a strip") {
  const Real height = 2, square = 1 + height * height / 12;  // squared root mean square radius
  const Slippage s = slippage_of(sums_of(strip(360, height)));
  CHECK(s.dimension() == 2);
  CHECK(s.value[0] < 1e-6);
  CHECK(s.value[1] < 1e-4);  // the rings of triangles are prisms
  // Tilts: mean of z^2 cos^2 over the radius squared; side translations: mean of cos^2.
  const Real tilt = height * height / 12 / 2 / square;
  CHECK(s.value[2] == doctest::Approx(tilt).epsilon(0.01));
  CHECK(s.value[3] == doctest::Approx(tilt).epsilon(0.01));
  CHECK(s.value[4] == doctest::Approx(0.5).epsilon(0.01));
  CHECK(s.value[5] == doctest::Approx(0.5).epsilon(0.01));
  check_values(strip(60, 4), {0, 0, 0.083, 0.145, 0.854, 0.912}, 2);
}

TEST_CASE("extrusion, revolution and helix slip one way, freeform none") {
  const auto dimension = [](const FaceGraph& g) { return slippage_of(sums_of(g)).dimension(); };
  CHECK(dimension(sheet([](Real u, Real v) {  // elliptic cylinder
          return Vec3(2 * std::cos(2 * kPi * u), std::sin(2 * kPi * u), 3 * v);
        })) == 1);
  CHECK(dimension(test::face_graph(test::torus(1, 0.4, 120, 60))) == 1);
  CHECK(dimension(sheet([](Real u, Real v) {  // cone
          const Real r = 1 - 0.8 * v;
          return Vec3(r * std::cos(2 * kPi * u), r * std::sin(2 * kPi * u), 1.5 * v);
        })) == 1);
  CHECK(dimension(sheet([](Real u, Real v) {  // helicoid
          const Real a = 2 * kPi * u, r = 2 * v - 1;
          return Vec3(r * std::cos(a), r * std::sin(a), 0.5 * a);
        })) == 1);
  CHECK(dimension(test::face_graph(test::ellipsoid(5, 1, 1.5, 2.2))) == 0);
}

TEST_CASE("values do not change with place, turn and size; sums of two pieces are the sum's") {
  const Soup torus = test::torus(1, 0.4, 60, 30);
  const Eigen::AngleAxisd turn(1.1, Vec3(0.3, -1, 0.7).normalized());
  const Slippage here = slippage_of(sums_of(test::face_graph(torus)));
  const FaceGraph moved = test::face_graph(
      test::transformed(torus, [&](const Vec3& p) { return Vec3(2.5 * (turn * p) + Vec3(4, -3, 2)); }));
  const Slippage there = slippage_of(sums_of(moved));
  for (int i = 0; i < 6; ++i) CHECK(std::abs(here.value[i] - there.value[i]) < 1e-10);
  SlippageSums first, second;
  for (Index f = 0; f < moved.faces(); ++f)
    (f % 3 == 0 ? first : second).add(moved.area[f], moved.centroid[f], moved.normal[f]);
  first += second;
  CHECK((slippage_of(first).value - there.value).norm() < 1e-12);
  Real mean = 0, area = 0;  // the values are means of what single points give
  for (Index f = 0; f < moved.faces(); ++f)
    mean += moved.area[f] * there.error_at(moved.centroid[f], moved.normal[f], 2), area += moved.area[f];
  CHECK(mean / area == doctest::Approx(there.error(2)));
}

TEST_CASE("a cube is six planes; two shapes keep to themselves; no surface, no motion") {
  const FaceGraph cube = test::face_graph(test::cube(16));
  const PatchLabels six = segment_by_slippage(Work(), cube, {.patches = 6});
  REQUIRE(six.count == 6);
  for (Index a = 0; a < cube.faces(); a += 7)
    for (Index b = 0; b < cube.faces(); b += 5)
      REQUIRE((six.patch_of_face[a] == six.patch_of_face[b]) == (cube.normal[a].dot(cube.normal[b]) > 0.5));
  const FaceGraph two = test::face_graph(test::side_by_side(test::icosphere(4), test::cube(16)));
  const PatchLabels seven = segment_by_slippage(Work(), two, {.patches = 7});
  CHECK(seven.count == 7);
  CHECK(test::pieces_equal_regions(two, seven.patch_of_face, 7));
  CHECK(slippage_of(SlippageSums{}).value.isZero());
}

TEST_CASE("patches of a bumpy surface: connected, as many as asked for, whatever the threads") {
  const FaceGraph g = test::face_graph(test::jittered(test::torus(1, 0.4, 60, 30), 0.02, 9));
  const auto run = [&](int threads) {
    return test::run_with_threads(threads, [&] { return segment_by_slippage(Work(), g, {.patches = 13}); });
  };
  const PatchLabels one = run(1);
  CHECK(one.count == 13);
  CHECK(test::pieces_equal_regions(g, one.patch_of_face, 13));
  CHECK(run(2) == one);
  CHECK(run(4) == one);
}
