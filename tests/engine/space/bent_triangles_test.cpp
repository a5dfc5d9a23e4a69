#include "engine/space/bent_triangles.h"

#include <cmath>

#include <doctest/doctest.h>

using namespace intarsia;

namespace {

// A strip of a cylinder of radius 1 about the x axis, within `half` radians of the top, from its two straight sides:
// `n` points each, triangles between.
struct Strip {
  std::vector<Vec3> point, inward;
  std::vector<Index> offset{0};
  std::vector<std::array<Index, 3>> triangle;

  Strip(Real half, Index n) {
    for (Index i = 0; i < n; ++i) add(2.0 * i / n, -half, 1);
    for (Index i = 0; i < n; ++i) add(2.0 - 2.0 * (i + 1) / n, half, -1);
    offset.push_back(2 * n);
    for (Index i = 0; i + 1 < n; ++i) {
      triangle.push_back({i, i + 1, 2 * n - 1 - i});
      triangle.push_back({i + 1, 2 * n - 2 - i, 2 * n - 1 - i});
    }
  }
  void add(Real x, Real angle, Real sign) {
    point.push_back({x, std::sin(angle), std::cos(angle)});
    inward.push_back(sign * Vec3(0, std::cos(angle), -std::sin(angle)));
  }
};

}  // namespace

TEST_CASE("across a strip of a cylinder the middle rises as a cubic with these tangents does") {
  for (const Real half : {0.2, 0.5, 1.0}) {
    const Strip s(half, 20);
    BentTriangles bent;
    bent.assign(s.point, s.inward, s.offset, s.triangle);
    // A side across, from point 10 to the one opposite: its middle is up by sin^2(half) / 2.
    const std::size_t t = 20;
    const auto [a, b, c] = s.triangle[t];
    REQUIRE((s.point[c] - s.point[a]).norm() < 2.1 * std::sin(half));
    const Vec3 middle = 0.5 * (s.point[a] + s.point[c]);
    const Vec3 up = bent.offset_at(t, middle);
    CHECK(up.z() == doctest::Approx(std::sin(half) * std::sin(half) / 2).epsilon(0.02));
    CHECK(std::abs(up.y()) < 0.01);
    // The cylinder itself is 1 - cos(half) up there: near that for a narrow strip.
    if (half < 0.3) CHECK((middle + up).tail<2>().norm() == doctest::Approx(1).epsilon(0.001));
  }
}

TEST_CASE("loops stay where they are, and without directions everything does") {
  Strip s(0.7, 12);
  BentTriangles bent;
  bent.assign(s.point, s.inward, s.offset, s.triangle);
  for (std::size_t t = 0; t < s.triangle.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = s.triangle[t][i], b = s.triangle[t][(i + 1) % 3];
      CHECK(bent.offset_at(t, s.point[a]).norm() < 1e-15);
      if (b == a + 1) CHECK(bent.offset_at(t, 0.3 * s.point[a] + 0.7 * s.point[b]).norm() < 1e-12);
    }
  for (Vec3& in : s.inward) in.setZero();
  bent.assign(s.point, s.inward, s.offset, s.triangle);
  for (std::size_t t = 0; t < s.triangle.size(); ++t) {
    const auto [a, b, c] = s.triangle[t];
    CHECK(bent.offset_at(t, (s.point[a] + s.point[b] + s.point[c]) / 3) == Vec3(0, 0, 0));
  }
}

TEST_CASE("a flat loop whose directions lie in its plane stays flat; a triangle without area is left alone") {
  std::vector<Vec3> point, inward;
  for (int k = 0; k < 8; ++k) {
    const Real a = k * std::acos(-1.0) / 4;
    point.push_back({std::cos(a), std::sin(a), 0}), inward.push_back(-point.back());
  }
  point[4] = 0.5 * (point[3] + point[5]);
  const std::vector<Index> offset{0, 8};
  const std::vector<std::array<Index, 3>> fan{{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {0, 5, 6}, {0, 6, 7}, {3, 4, 5}};
  BentTriangles bent;
  bent.assign(point, inward, offset, fan);
  for (std::size_t t = 0; t < fan.size(); ++t) {
    const auto [a, b, c] = fan[t];
    const Vec3 d = bent.offset_at(t, (point[a] + point[b] + point[c]) / 3);
    CHECK(d.allFinite());
    CHECK(std::abs(d.z()) < 1e-15);
  }
  CHECK(bent.offset_at(5, point[4]) == Vec3(0, 0, 0));
}
