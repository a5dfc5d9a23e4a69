#include "engine/space/few_triangles.h"

#include <limits>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "engine/space/point_triangle.h"

using namespace intarsia;

namespace {

using Triangles = std::vector<std::array<Index, 3>>;

Real one_by_one(const std::vector<Vec3>& point, const Triangles& triangle, const Vec3& p) {
  Real least = std::numeric_limits<Real>::infinity();
  for (const auto& [a, b, c] : triangle)
    least = std::min(least, (p - closest_on_triangle(p, point[a], point[b], point[c])).squaredNorm());
  return least;
}

}  // namespace

TEST_CASE("distances to a few triangles are those of each alone, bit by bit, slivers and points among them") {
  std::mt19937 random(7);
  const auto any = [&](Real scale) {
    std::uniform_real_distribution<Real> u(-scale, scale);
    return Vec3(u(random), u(random), u(random));
  };
  FewTriangles few;
  for (int round = 0; round < 200; ++round) {
    std::vector<Vec3> point;
    Triangles triangle;
    const Index count = 1 + random() % 40;
    for (Index t = 0; t < count; ++t) {
      const Index first = static_cast<Index>(point.size());
      const Vec3 a = any(1), b = a + any(0.5), c = b + any(0.5);
      point.insert(point.end(), {a, b, c});
      if (round % 3 == 1 && t % 4 == 0) point.back() = 0.3 * a + 0.7 * b + 1e-12 * any(1);  // nearly no area
      if (round % 3 == 2 && t % 5 == 0) point.back() = b, point[first] = t % 2 ? a : b;     // a segment or a point
      triangle.push_back({first, first + 1, first + 2});
    }
    few.assign(point, triangle);
    for (int k = 0; k < 50; ++k) {
      const auto& t = triangle[random() % triangle.size()];
      const Vec3 p = k % 3 == 0   ? any(3)
                     : k % 3 == 1 ? Vec3((point[t[0]] + point[t[1]] + point[t[2]]) / 3 + any(1e-9))
                                  : Vec3(0.5 * (point[t[0]] + point[t[1]]) + any(0.01));
      CHECK(few.distance2(p) == one_by_one(point, triangle, p));
    }
  }
}
