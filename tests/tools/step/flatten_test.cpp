#include "tools/step/flatten.h"

#include <numbers>

#include <doctest/doctest.h>

#include "tests/tools/step/pieces.h"

using namespace intarsia;
using namespace intarsia::tools;

namespace {

// Ratios of the edges' lengths in the plane and in space: smallest and largest.
std::pair<Real, Real> stretch(const PatchPiece& piece, const std::vector<Vec2>& uv) {
  Real low = 1e300, high = 0;
  for (const auto& t : piece.triangle)
    for (int i = 0; i < 3; ++i) {
      const Real ratio =
          (uv[t[i]] - uv[t[(i + 1) % 3]]).norm() / (piece.point[t[i]] - piece.point[t[(i + 1) % 3]]).norm();
      low = std::min(low, ratio), high = std::max(high, ratio);
    }
  return {low, high};
}

}  // namespace

TEST_CASE("a plane projects onto itself, a deep cap does not project") {
  const PatchPiece flat = test::grid_piece(5, 7, [](Real u, Real v) { return Vec3(u, 2 * v, 3 + u); });
  const std::vector<Vec2> uv = project(flat);
  REQUIRE(uv.size() == flat.point.size());
  const auto [low, high] = stretch(flat, uv);
  CHECK(low == doctest::Approx(1).epsilon(1e-12));
  CHECK(high == doctest::Approx(1).epsilon(1e-12));
  CHECK(turned_area(flat, uv).turned == 0);
  CHECK(project(test::sphere_cap(20, 0.75 * std::numbers::pi)).empty());
}

TEST_CASE("maps to the circle turn no triangle, however deep the cap") {
  for (const Real reach : {0.5, 1.5, 2.5, 3.0}) {
    CAPTURE(reach);
    const PatchPiece cap = test::sphere_cap(24, reach);
    const std::vector<Vec2> uv = map_to_circle(cap);
    const TurnedArea area = turned_area(cap, uv);
    CHECK(area.turned == 0);
    CHECK(area.all > 0);
    CHECK(!borders_cross(cap, uv));
    const std::vector<Vec2> better = reduce_distortion(cap, uv);
    CHECK(turned_area(cap, better).turned == 0);
    CHECK(!borders_cross(cap, better));
    const auto before = stretch(cap, uv), after = stretch(cap, better);
    CHECK(after.second / after.first < before.second / before.first);
  }
}

TEST_CASE("a square that is squeezed half a million times against a circle becomes a square again") {
  const PatchPiece square = test::grid_piece(30, 30, [](Real u, Real v) { return Vec3(u, v, 0); });
  std::vector<Vec2> squeezed;
  for (const Vec3& p : square.point) {
    const Real r = 2 - std::exp(13 * (p.y() - 1)), a = 1 - 2 * p.x();  // towards a circle
    squeezed.emplace_back(r * std::sin(a), r * std::cos(a));
  }
  REQUIRE(turned_area(square, squeezed).turned == 0);
  const std::vector<Vec2> uv = reduce_distortion(square, squeezed, 200);
  const auto [low, high] = stretch(square, uv);
  CHECK(low > 0.8);
  CHECK(high < 1.2);
}

TEST_CASE("a developable patch unrolls with little distortion, also past a full turn's three quarters") {
  const PatchPiece sector = test::cylinder_sector(60, 12, 1.7 * std::numbers::pi);
  const std::vector<Vec2> uv = reduce_distortion(sector, map_to_circle(sector), 200);
  const auto [low, high] = stretch(sector, uv);
  CHECK(low > 0.8);
  CHECK(high < 1.15);
}

TEST_CASE("a hole stays a hole") {
  // A ring between two circles, the inner one raised.
  PatchPiece ring;
  constexpr Index n = 40;
  for (Index i = 0; i < n; ++i)
    for (int k = 0; k < 2; ++k) {
      const Real angle = 2 * std::numbers::pi * i / n, r = k ? 2 : 1;
      ring.point.push_back({r * std::cos(angle), r * std::sin(angle), k ? 0.0 : 1.0});
      ring.vertex.push_back(static_cast<Index>(ring.vertex.size()));
    }
  ring.loop.resize(2);
  ring.loop[0].length = 4 * std::numbers::pi, ring.loop[1].length = 2 * std::numbers::pi;
  for (Index i = 0; i < n; ++i) {
    const Index a = 2 * i, b = 2 * ((i + 1) % n);
    ring.triangle.push_back({a, a + 1, b + 1}), ring.triangle.push_back({a, b + 1, b});
    ring.loop[0].point.push_back(a + 1), ring.loop[1].point.push_back(2 * (n - 1 - i));
  }
  ring.loop[0].side = {{0, 0}}, ring.loop[1].side = {{2, 0}};
  ring.euler = 0;
  REQUIRE(ring.is_flat_in_kind());
  const std::vector<Vec2> uv = reduce_distortion(ring, map_to_circle(ring));
  CHECK(turned_area(ring, uv).turned == 0);
  CHECK(!borders_cross(ring, uv));
}

TEST_CASE("crossing borders are noticed, rectangles turned straight") {
  PatchPiece piece = test::grid_piece(1, 1, [](Real u, Real v) { return Vec3(u, v, 0); });
  std::vector<Vec2> uv = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
  CHECK(!borders_cross(piece, uv));
  std::swap(uv[0], uv[1]);
  CHECK(borders_cross(piece, uv));
  std::vector<Vec2> turned;
  for (const Vec2& p : {Vec2(0, 0), Vec2(3, 0), Vec2(3, 1), Vec2(0, 1)})
    turned.push_back(Eigen::Rotation2Dd(std::numbers::pi / 6) * p);
  align_to_axes(turned);
  const Vec2 size = (turned[2] - turned[0]).cwiseAbs();
  CHECK(size.maxCoeff() == doctest::Approx(3));
  CHECK(size.minCoeff() == doctest::Approx(1));
}
