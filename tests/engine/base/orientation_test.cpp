#include "engine/base/orientation.h"

#include <cmath>

#include <doctest/doctest.h>

#include "engine/base/random.h"

using namespace intarsia;

TEST_CASE("signs of points with whole coordinates, against whole arithmetic") {
  const Random random(5, 1);
  std::uint64_t draw = 0;
  int zeros = 0;
  for (int round = 0; round < 20000; ++round) {
    std::int64_t p[4][3];
    Vec3 q[4];
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k)
        p[i][k] = static_cast<std::int64_t>(random.bits(0, draw++) % 9) - 4, q[i][k] = static_cast<Real>(p[i][k]);
    std::int64_t m[3][3];
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) m[i][k] = p[i][k] - p[3][k];
    const std::int64_t volume = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                                m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                                m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    const std::int64_t n[4] = {p[0][0] - p[2][0], p[0][1] - p[2][1], p[1][0] - p[2][0], p[1][1] - p[2][1]};
    const std::int64_t area = n[0] * n[3] - n[1] * n[2];
    REQUIRE(orientation(q[0], q[1], q[2], q[3]) == (volume > 0) - (volume < 0));
    REQUIRE(orientation(q[0], q[1], q[2], 0, 1) == (area > 0) - (area < 0));
    zeros += volume == 0 ? 1 : 0;
  }
  CHECK(zeros > 500);
}

TEST_CASE("one unit in the last place decides") {
  // on the plane x = y, far from the origin; the last point leaves it by the least possible step
  const Vec3 a(0.1, 0.1, 0.3), b(12.7, 12.7, -4.1), c(24.1, 24.1, 7.7);
  const Real x = 0.7;
  CHECK(orientation(a, b, c, Vec3(x, x, 1.1)) == 0);
  const int up = orientation(a, b, c, Vec3(x, std::nextafter(x, 1), 1.1));
  const int down = orientation(a, b, c, Vec3(x, std::nextafter(x, 0), 1.1));
  CHECK(up == -down);
  CHECK(up != 0);
  CHECK(orientation(b, a, c, Vec3(x, std::nextafter(x, 1), 1.1)) == -up);
  CHECK(orientation(a, b, Vec3(x, x, 0), 0, 1) == 0);
  CHECK(orientation(a, b, Vec3(x, std::nextafter(x, 1), 0), 0, 1) == 1);
}
