#include "kernels/quality/transfinite_patch.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "engine/base/random.h"

namespace intarsia {
namespace {

using kernels::SideCurve;
using kernels::TransfinitePatch;

// n random cubic curves that form a loop, sampled.
std::vector<SideCurve> random_sides(Index n, std::uint64_t seed, Real height = 1) {
  const Random random(seed, 9);
  std::vector<Vec3> corner;
  for (Index i = 0; i < n; ++i) {
    const Real a = 2 * std::numbers::pi * i / n;
    corner.emplace_back(std::cos(a) + .3 * random.uniform(i, 0), std::sin(a) + .3 * random.uniform(i, 1),
                        height * random.uniform(i, 2));
  }
  std::vector<SideCurve> side;
  for (Index i = 0; i < n; ++i) {
    const Vec3 a = corner[(i + n - 1) % n], d = corner[i];
    const auto offset = [&](std::uint64_t k) {
      return Vec3(.3 * random.uniform(i, k), .3 * random.uniform(i, k + 1), .5 * height * random.uniform(i, k + 2));
    };
    const Vec3 b = a + (d - a) / 3 + offset(10), c = a + 2 * (d - a) / 3 + offset(20);
    std::vector<Vec3> point;
    for (int s = 0; s <= 24; ++s) {
      const Real t = s / 24.0, u = 1 - t;
      point.push_back(u * u * u * a + 3 * u * u * t * b + 3 * u * t * t * c + t * t * t * d);
    }
    point.front() = a, point.back() = d;
    side.emplace_back(std::move(point));
  }
  return side;
}

// A random point inside the domain polygon.
Vec3 inside(const TransfinitePatch& patch, std::uint64_t i) {
  const Random random(4, 11);
  std::vector<Real> weight;
  Real sum = 0;
  for (Index j = 0; j < patch.sides(); ++j) weight.push_back(-std::log(1 - random.uniform(i, j))), sum += weight.back();
  Vec3 p = Vec3::Zero();
  for (Index j = 0; j < patch.sides(); ++j) p += weight[j] / sum * patch.corner(j);
  return p;
}

SideCurve arc(const Vec3& from, const Vec3& to, int segments) {
  std::vector<Vec3> point;
  for (int i = 0; i <= segments; ++i) {
    const Real t = std::numbers::pi / 2 * i / segments;
    point.push_back(std::cos(t) * from + std::sin(t) * to);
  }
  point.front() = from, point.back() = to;
  return SideCurve(std::move(point));
}

}  // namespace

TEST_CASE("a transfinite patch interpolates its border") {
  for (Index n = 3; n <= 8; ++n)
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const TransfinitePatch patch(random_sides(n, seed));
      for (Index i = 0; i < n; ++i) {
        const Vec3 corner = patch.corner(i);
        CHECK((patch.at(corner.x(), corner.y()) - patch.side(i).points().back()).norm() < 1e-12);
        for (int k = 0; k <= 20; ++k) {
          const Real s = k / 20.0;
          const Vec3 p = patch.on_side(i, s);
          CHECK((patch.at(p.x(), p.y()) - patch.side(i).at(s)).norm() < 1e-12);
          // It meets its border continuously.
          const Vec3 near = (1 - 1e-9) * p;
          CHECK((patch.at(near.x(), near.y()) - patch.side(i).at(s)).norm() < 1e-7);
        }
      }
    }
}

TEST_CASE("planar borders give planar patches, affine maps commute") {
  Eigen::Matrix3d map;
  map << 1, .3, -.2, .1, 2, .4, -.5, .2, 1;
  for (Index n = 3; n <= 8; ++n) {
    const TransfinitePatch flat(random_sides(n, n, 0)), patch(random_sides(n, n));
    std::vector<SideCurve> mapped;
    for (const SideCurve& side : random_sides(n, n)) {
      std::vector<Vec3> point;
      for (const Vec3& p : side.points()) point.push_back(1.5 * p + Vec3(1, 2, 3));
      mapped.emplace_back(std::move(point));
    }
    const TransfinitePatch moved(std::move(mapped));
    for (std::uint64_t k = 0; k < 50; ++k) {
      const Vec3 p = inside(flat, k);
      CHECK(std::abs(flat.at(p.x(), p.y()).z()) < 1e-12);
      CHECK((moved.at(p.x(), p.y()) - (1.5 * patch.at(p.x(), p.y()) + Vec3(1, 2, 3))).norm() < 1e-12);
    }
  }
}

TEST_CASE("four straight sides of a skew quadrilateral: the bilinear patch") {
  const std::vector<Vec3> c = {{0, 0, 0}, {1, 0, .5}, {1, 1, -.3}, {0, 1, 1}};
  std::vector<SideCurve> side;
  for (std::size_t i = 0; i < 4; ++i) side.push_back(SideCurve({c[i], c[(i + 1) % 4]}));
  const TransfinitePatch patch(std::move(side));
  CHECK((patch.at(0, 0) - (c[0] + c[1] + c[2] + c[3]) / 4).norm() < 1e-14);
}

TEST_CASE("four sides give the patch of Coons") {
  const TransfinitePatch patch(random_sides(4, 3));
  // Domain corners at angles 0, 90, 180, 270 degrees; side i ends in corner i. Side 0 at v = 0, side 1 at u = 1.
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const Vec3 p = inside(patch, k);
    // Corner 3 is u = v = 0, corner 0 is (1, 0), corner 1 is (1, 1).
    const Real u = (1 + p.x() + p.y()) / 2, v = (1 + p.y() - p.x()) / 2;
    const Vec3 low = patch.side(0).at(u), high = patch.side(2).at(1 - u);
    const Vec3 left = patch.side(3).at(1 - v), right = patch.side(1).at(v);
    const Vec3 a = patch.side(0).at(0), b = patch.side(0).at(1), c = patch.side(2).at(0), d = patch.side(2).at(1);
    const Vec3 coons = (1 - v) * low + v * high + (1 - u) * left + u * right -
                       ((1 - u) * (1 - v) * a + u * (1 - v) * b + u * v * c + (1 - u) * v * d);
    CHECK((patch.at(p.x(), p.y()) - coons).norm() < 1e-14);
  }
}

TEST_CASE("the octant of a sphere") {
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const TransfinitePatch patch({arc(z, x, 4000), arc(x, y, 4000), arc(y, z, 4000)});
  const Vec3 centre = patch.at(0, 0);
  CHECK(centre.norm() == doctest::Approx(.948106).epsilon(2e-6));
  CHECK((centre.normalized() - Vec3(1, 1, 1).normalized()).norm() < 1e-9);
}

TEST_CASE("coordinates and weights add up to 1, and are numbers everywhere") {
  for (Index n = 3; n <= 9; ++n) {
    const TransfinitePatch patch(random_sides(n, 1));
    std::vector<Real> lambda(n);
    const auto check = [&](const Vec3& p) {
      patch.coordinates(p.x(), p.y(), lambda);
      Real sum = 0, weights = 0;
      Vec3 back = Vec3::Zero();
      for (Index i = 0; i < n; ++i) {
        CHECK(lambda[i] >= 0);
        sum += lambda[i], weights += (lambda[i] + lambda[(i + n - 1) % n]) / 2;
        back += lambda[i] * patch.corner(i);
      }
      CHECK(std::abs(sum - 1) < 1e-14);
      CHECK(std::abs(weights - 1) < 1e-14);
      CHECK((back - p).norm() < 1e-9);
      CHECK(patch.at(p.x(), p.y()).allFinite());
    };
    for (std::uint64_t k = 0; k < 1000; ++k) check(inside(patch, k));
    for (Index i = 0; i < n; ++i)
      for (const Real s : {0.0, 1e-12, .5, 1.0}) check(patch.on_side(i, s));
  }
}

TEST_CASE("sides without length are points") {
  const SideCurve still({Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)});
  CHECK(still.at(.3) == Vec3(1, 1, 1));
  CHECK(still.slope_at_start() == Vec3::Zero());
  const TransfinitePatch patch(
      {still, SideCurve({Vec3(1, 1, 1), Vec3(2, 1, 1)}), SideCurve({Vec3(2, 1, 1), Vec3(1, 1, 1)})});
  CHECK(patch.at(.1, .1).allFinite());
}

}  // namespace intarsia
