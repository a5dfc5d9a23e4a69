#include "engine/space/point_tree.h"

#include <doctest/doctest.h>

#include "engine/base/random.h"

using namespace intarsia;

namespace {

Vec3Array random_points(Index n) {
  const Random random(7, 1);
  Vec3Array p(n);
  // A coarse lattice, so that many points coincide and many distances are equal.
  for (Index i = 0; i < n; ++i)
    p.set(i, Vec3(std::floor(8 * random.uniform(i, 0)), std::floor(8 * random.uniform(i, 1)),
                  std::floor(8 * random.uniform(i, 2))));
  return p;
}

}  // namespace

TEST_CASE("nearest and in-radius points agree with looking at all, ties by id") {
  const Vec3Array points = random_points(900);
  const PointTree tree(points);
  CHECK(tree.size() == 900);
  const Random random(8, 2);
  std::vector<Index> found;
  for (Index q = 0; q < 200; ++q) {
    Vec3 p(9 * random.uniform(q, 0), 9 * random.uniform(q, 1), 9 * random.uniform(q, 2));
    if (q % 2) p = p.array().floor();
    Index best = 0;
    std::vector<Index> expected;
    for (Index i = 0; i < 900; ++i) {
      if ((points[i] - p).squaredNorm() < (points[best] - p).squaredNorm()) best = i;
      if ((points[i] - p).squaredNorm() <= 4) expected.push_back(i);
    }
    CHECK(tree.nearest(p) == best);
    tree.in_radius(p, 2, found);
    CHECK(found == expected);
  }
}

TEST_CASE("trees of no point and of one") {
  const PointTree empty{Vec3Array()};
  CHECK(empty.nearest(Vec3::Zero()) == kNone);
  std::vector<Index> found{1};
  empty.in_radius(Vec3::Zero(), 1, found);
  CHECK(found.empty());
  Vec3Array one(1);
  one.set(0, Vec3(1, 2, 3));
  PointTree tree{one};
  CHECK(tree.nearest(Vec3(100, 0, 0)) == 0);
  tree.in_radius(Vec3(1, 2, 4), 1, found);
  CHECK(found == std::vector<Index>{0});
  tree.in_radius(Vec3(1, 2, 4), 0.999, found);
  CHECK(found.empty());
}
