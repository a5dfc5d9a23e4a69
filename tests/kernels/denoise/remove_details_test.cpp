#include "kernels/denoise/remove_details.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "tests/support/surface.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

// A unit square with waves of a wavelength and a height.
Soup waves(Real length, Real height) {
  return height_field(101, 101, 0, 1, 0, 1, [=](Real x, Real y) {
    return height * std::sin(2 * std::numbers::pi * x / length) * std::sin(2 * std::numbers::pi * y / length);
  });
}

// RMS height of the inner part after / before.
Real kept(const Soup& soup, Real size) {
  const TestSurface s = make_surface(soup);
  const Vec3Array p = remove_details({}, s.mesh, size / s.box.diagonal, s.mean_edge, {});
  Real before = 0, after = 0;
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
    const Vec3 q = s.input_point(v);
    if (std::min({q.x(), q.y(), 1 - q.x(), 1 - q.y()}) < 0.15) continue;
    before += q.z() * q.z(), after += std::pow(s.box.to_input(p[v]).z(), 2);
  }
  return std::sqrt(after / before);
}

}  // namespace

TEST_CASE("waves shorter than the size go, much longer ones stay") {
  CHECK(kept(waves(0.08, 0.004), 0.08) < 0.3);
  CHECK(kept(waves(0.8, 0.04), 0.08) > 0.9);
}

TEST_CASE("sharp edges stay sharp") {
  const TestSurface s = make_surface(cube(24));
  const Vec3Array p = remove_details({}, s.mesh, 0.06, s.mean_edge, {});
  Real farthest = 0;
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) farthest = std::max(farthest, (p[v] - s.point(v)).norm());
  CHECK(farthest < 0.5 * s.mean_edge);  // size: 2.6 mean edges
}
