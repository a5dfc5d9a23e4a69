#include "kernels/curves/tidy_curves.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "tests/kernels/curves/curve_case.h"

using namespace intarsia;
using namespace intarsia::test;

TEST_CASE("a spur goes and the two curves it met become one; long side branches and loose lines stay") {
  const TestSurface s = make_surface(plane(20, 20));
  const auto branch = [&](int length) {
    FeatureCurves c;
    draw(c, grid_row(s, 2, 8, 10, 20));
    const Index junction = c.points_of(0).back();
    draw(c, grid_row(s, 8, 15, 10, 20), CurveKind::ridge, false, 1, junction);
    std::vector<Index> up;
    for (int y = 10; y <= 10 + length; ++y) up.push_back(vertex_near(s, Vec3(0.4, y / 20.0, 0)));
    draw(c, up, CurveKind::ridge, false, 1, junction);
    kernels::remove_spurs({}, s.mesh, 4 * s.mean_edge, c);
    return c;
  };
  const FeatureCurves cut = branch(2);
  REQUIRE(cut.curve_count() == 1);
  CHECK(cut.points_of(0).size() == 14);
  CHECK(branch(8).curve_count() == 3);
}

TEST_CASE("fragments go, short pieces between junctions and sharp chains stay") {
  const TestSurface s = make_surface(plane(20, 20));
  FeatureCurves c;
  draw(c, grid_row(s, 2, 4, 3, 20));
  draw(c, grid_row(s, 2, 4, 5, 20), CurveKind::sharp);
  draw(c, grid_row(s, 2, 12, 7, 20));
  const Index a = c.points_of(2)[4], b = c.point_count();
  draw(c, grid_row(s, 2, 12, 9, 20));
  c.add_curve({a, b + 4}, CurveKind::ridge, false);
  kernels::remove_fragments({}, s.mesh, 4 * s.mean_edge, c);
  CHECK(c.curve_count() == 4);
  CHECK(c.net.kind[0] == CurveKind::sharp);
}

TEST_CASE("tails are cut where the mean turn angle is small, but never past a junction or on a loop") {
  const TestSurface s = make_surface(plane(40, 40));
  FeatureCurves c;
  draw(c, grid_row(s, 2, 32, 10, 40));
  for (Index i = 0; i < 12; ++i) c.turn()[i] = 0;  // then 1
  draw(c, grid_row(s, 2, 20, 20, 40), CurveKind::ridge, false, 0.1);
  kernels::trim_tails({}, 0.2, 7, c);
  REQUIRE(c.curve_count() == 1);
  // The mean over seven points reaches 0.2 where two of them are strong: two points before the first.
  CHECK(c.points_of(0).front() == 10);
  CHECK(c.points_of(0).back() == 30);

  FeatureCurves tee;
  draw(tee, grid_row(s, 2, 32, 10, 40));
  for (Index i = 0; i < 12; ++i) tee.turn()[i] = 0;
  std::vector<Index> up;
  for (int y = 10; y < 30; ++y) up.push_back(vertex_near(s, Vec3(6 / 40.0, y / 40.0, 0)));
  draw(tee, up, CurveKind::ridge, false, 1, 4);
  kernels::trim_tails({}, 0.2, 7, tee);
  REQUIRE(tee.curve_count() == 1);  // what is left of the two meets end to end
  const auto row = tee.points_of(0);
  CHECK(std::count_if(row.begin(), row.end(), [](Index p) { return p < 4; }) == 0);
  CHECK(std::count(row.begin(), row.end(), 4) == 1);
}

TEST_CASE("selection compacts points in order and carries measures over; channels are put one after the other") {
  const TestSurface s = make_surface(plane(10, 10));
  FeatureCurves a, b;
  draw(a, grid_row(s, 1, 3, 1, 10));
  draw(a, grid_row(s, 4, 8, 1, 10));
  draw(b, grid_row(s, 1, 5, 4, 10), CurveKind::valley, true);
  const FeatureCurves* sets[] = {&a, &b};
  FeatureCurves all = kernels::merge_channels(sets);
  REQUIRE(all.curve_count() == 3);
  all.length = {1, 2, 3}, all.rms_curvature = all.strength = all.saliency = all.length;
  all.component = {0, 1, 2};
  const std::vector<std::uint8_t> keep{0, 1, 1};
  const FeatureCurves some = kernels::select_curves({}, all, keep);
  CHECK(some.point_count() == 10);
  CHECK(some.length == std::vector<Real>{2, 3});
  CHECK(some.component == std::vector<Index>{1, 2});
  CHECK(some.net.kind[1] == CurveKind::valley);
  CHECK(some.net.point[some.points_of(1)[0]] == b.net.point[b.points_of(0)[0]]);
  CHECK(some.net.point[some.points_of(0)[0]] == a.net.point[a.points_of(1)[0]]);
}
