#include "kernels/quality/refine_patch.h"

#include <cmath>
#include <map>
#include <numbers>

#include <doctest/doctest.h>

#include "kernels/quality/thin_plate.h"

namespace intarsia {
namespace {

using Triangles = std::vector<std::array<Index, 3>>;

// A polygon with a fan from its first point, and what refinement makes of it.
struct Refined {
  std::vector<Vec3> point;
  Triangles triangle;
  Index border;
};

Refined refined(std::vector<Vec3> loop, const kernels::RefineOptions& options = {}) {
  Refined r{std::move(loop), {}, 0};
  r.border = static_cast<Index>(r.point.size());
  for (Index i = 1; i + 1 < r.border; ++i) r.triangle.push_back({0, i, i + 1});
  kernels::refine_patch(r.point, r.triangle, options);
  return r;
}

std::vector<Vec3> circle(Index n, Real radius = 1) {
  std::vector<Vec3> loop;
  for (Index i = 0; i < n; ++i) {
    const Real a = 2 * std::numbers::pi * i / n;
    loop.emplace_back(radius * std::cos(a), radius * std::sin(a), 0);
  }
  return loop;
}

std::vector<Index> ring(Index n) {
  std::vector<Index> next;
  for (Index i = 0; i < n; ++i) next.push_back((i + 1) % n);
  return next;
}

}  // namespace

TEST_CASE("refinement keeps border, area and disc, and makes even Delaunay triangles") {
  for (const Index n : {12u, 60u}) {
    const Refined r = refined(circle(n));
    CHECK(r.point.size() > n);
    std::map<std::pair<Index, Index>, Index> opposite;  // half-edge -> corner opposite to it
    Real area = 0;
    for (const auto& t : r.triangle) {
      const Real twice = (r.point[t[1]] - r.point[t[0]]).cross(r.point[t[2]] - r.point[t[0]]).z();
      CHECK(twice > 0);
      area += twice / 2;
      for (std::size_t i = 0; i < 3; ++i) CHECK(opposite.try_emplace({t[i], t[(i + 1) % 3]}, t[(i + 2) % 3]).second);
    }
    CHECK(area == doctest::Approx(n / 2.0 * std::sin(2 * std::numbers::pi / n)).epsilon(1e-12));
    Index edges = 0;
    Real longest = 0;
    for (const auto& [h, c] : opposite) {
      const bool border = h.first < n && h.second == (h.first + 1) % n;
      const auto twin = opposite.find({h.second, h.first});
      CHECK((twin == opposite.end()) == border);
      edges += border || h.first < h.second ? 1 : 0;
      longest = std::max(longest, (r.point[h.first] - r.point[h.second]).norm());
      if (border) continue;
      const auto angle = [&r, h = h](Index apex) {
        const Vec3 a = r.point[h.first] - r.point[apex], b = r.point[h.second] - r.point[apex];
        return std::atan2(a.cross(b).norm(), a.dot(b));
      };
      CHECK(angle(c) + angle(twin->second) < std::numbers::pi + 1e-6);
    }
    CHECK(int(r.point.size()) - int(edges) + int(r.triangle.size()) == 1);
    const Real step = 2 * std::sin(std::numbers::pi / n);
    CHECK(longest < 2.5 * step);
  }
}

TEST_CASE("refinement stays within its number of points") {
  const Refined r = refined(circle(400), {.step = 1, .most_inner = 200});
  CHECK(r.point.size() <= 400 + 4 * 200);
  CHECK(r.point.size() > 400 + 50);
  // Degenerate polygons are left alone or refined, but give numbers.
  const std::vector<Vec3> place(6, Vec3(1, 2, 3)),
      line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {2, 0, 0}, {1, 0, 0}};
  for (const auto& loop : {place, line}) {
    const Refined thin = refined(loop);
    for (const Vec3& p : thin.point) CHECK(p.allFinite());
  }
}

TEST_CASE("a plate over a planar border with tangents in its plane is planar") {
  const Index n = 48;
  Refined r = refined(circle(n));
  for (Index i = n; i < r.point.size(); ++i) r.point[i].z() = .1;  // it starts off the plane
  kernels::GhostRow ghost;
  for (const Vec3& p : circle(n, .1)) ghost.outward.push_back(p), ghost.has.push_back(1);
  const auto shapes = kernels::solve_thin_plate(r.point, n, r.triangle, ring(n), ghost, {});
  REQUIRE(shapes.size() == 2);
  for (const auto& shape : shapes)
    for (const Vec3& p : shape) CHECK(std::abs(p.z()) < 1e-11);
}

TEST_CASE("tangents bend the plate") {
  // A disc whose tangents rise inwards by 1 at its border: the flat plate with these slopes is the paraboloid of height
  // 1/2; with the border's curvature it becomes a cap of the sphere, of height tan(pi / 8).
  const Index n = 96;
  const Refined r = refined(circle(n));
  kernels::GhostRow ghost;
  const Real step = 2 * std::numbers::pi / n;
  for (const Vec3& p : circle(n))
    ghost.outward.push_back(step * (p - Vec3(0, 0, 1)).normalized()), ghost.has.push_back(1);
  const auto height = [&](int flat, int bent) {
    const auto shapes = kernels::solve_thin_plate(r.point, n, r.triangle, ring(n), ghost, {flat, bent});
    REQUIRE(shapes.size() == std::size_t(flat + bent));
    Real top = 0;
    for (const Vec3& p : shapes.back()) top = std::max(top, p.z());
    return top;
  };
  CHECK(height(1, 6) == doctest::Approx(std::tan(std::numbers::pi / 8)).epsilon(.06));
  CHECK(height(3, 0) > .3);
  CHECK(height(3, 0) < .6);
  ghost.has.assign(n, 0);
  CHECK(height(1, 1) < 1e-11);
}

}  // namespace intarsia
