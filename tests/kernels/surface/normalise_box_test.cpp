#include "kernels/surface/normalise_box.h"

#include <limits>

#include <doctest/doctest.h>

#include "tests/support/surface.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

ErrorCode code_of(const Soup& soup, Index* element = nullptr) {
  try {
    kernels::normalise_box({}, soup);
  } catch (const Error& e) {
    if (element) *element = e.element();
    return e.code();
  }
  FAIL("no error");
  return ErrorCode::internal;
}

}  // namespace

TEST_CASE("the box of a cube") {
  const Soup soup = transformed(cube(4), [](const Vec3& p) { return Vec3(2 * p + Vec3(10, -4, 7)); });
  const auto t = kernels::normalise_box({}, soup);
  CHECK(t.centre == Vec3(11, -3, 8));
  CHECK(t.diagonal == doctest::Approx(2 * std::sqrt(3.0)).epsilon(1e-15));
  CHECK((t.to_input(t.to_unit({3, 2, 1})) - Vec3(3, 2, 1)).norm() < 1e-14);
  const TestSurface s = make_surface(soup);
  Vec3 low = s.point(0), high = low;
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) low = low.cwiseMin(s.point(v)), high = high.cwiseMax(s.point(v));
  CHECK((high - low).norm() == doctest::Approx(1).epsilon(1e-15));
  CHECK((high + low).norm() < 1e-15);
}

TEST_CASE("very large and very small meshes are normalised alike") {
  const TestSurface unit = make_surface(cube(3));
  for (Real scale : {0x1p-900, 0x1p-60, 0x1p+60, 0x1p+900}) {
    const TestSurface s = make_surface(scaled(cube(3), scale));
    CHECK(s.mesh.x == unit.mesh.x);
    CHECK(s.faces.area == unit.faces.area);
  }
}

TEST_CASE("no size, no numbers") {
  CHECK(code_of(scaled(cube(2), 0)) == ErrorCode::rejected);
  CHECK(code_of(Soup{}) == ErrorCode::rejected);
  CHECK(code_of(scaled(cube(2), 1e308 * 1.7)) == ErrorCode::rejected);
  Soup bad = cube(2);
  bad.y[5] = std::numeric_limits<Real>::quiet_NaN();
  bad.x[9] = std::numeric_limits<Real>::infinity();
  Index element = kNone;
  CHECK(code_of(bad, &element) == ErrorCode::rejected);
  CHECK(element == 5);
}

TEST_CASE("negative zero becomes zero") {
  const kernels::BoxTransform t;
  CHECK_FALSE(std::signbit(t.to_unit({-0.0, 1, 2}).x()));
}
