#include "kernels/curves/measure_curves.h"

#include <numbers>

#include <doctest/doctest.h>

#include "kernels/curves/turn_angle.h"
#include "tests/kernels/curves/curve_case.h"
#include "tests/support/quadric_fields.h"

using namespace intarsia;
using namespace intarsia::test;
using kernels::measure_curves;

TEST_CASE("length, curvature, strength and saliency of a straight curve of constant values") {
  const TestSurface s = make_surface(plane(20, 20));
  FeatureCurves c;
  draw(c, grid_row(s, 2, 12, 5, 20), CurveKind::ridge, false, 0.5);
  draw(c, grid_row(s, 3, 4, 9, 20));
  measure_curves({}, s.mesh, {}, c);
  const Real length = 0.5 / std::numbers::sqrt2;
  CHECK(c.length[0] == doctest::Approx(length));
  CHECK(c.rms_curvature[0] == doctest::Approx(std::sqrt(5)));  // k = 3, 1
  CHECK(c.strength[0] == doctest::Approx(length * length * 2));
  CHECK(c.saliency[0] == doctest::Approx(0.5 * length));
  CHECK(c.length[1] == doctest::Approx(length / 10));
  measure_curves({}, s.mesh, {.plain_mean = true}, c);
  CHECK(c.rms_curvature[0] == doctest::Approx(std::sqrt(5)));
}

TEST_CASE("the plain mean counts points, the default counts length") {
  const TestSurface s = make_surface(plane(20, 20));
  FeatureCurves c;
  draw(c, {vertex_near(s, {0, 0, 0}), vertex_near(s, {0.05, 0, 0}), vertex_near(s, {0.95, 0, 0})});
  c.kmax = {1, 1, 4}, c.kmin = {1, 1, 4};
  measure_curves({}, s.mesh, {}, c);
  CHECK(c.rms_curvature[0] == doctest::Approx((1 * 1.0 + 18 * 2.5) / 19));
  measure_curves({}, s.mesh, {.plain_mean = true}, c);
  CHECK(c.rms_curvature[0] == doctest::Approx(2));
}

TEST_CASE("strength does not depend on the scale, length and curvature go with it") {
  const TestSurface s = make_surface(plane(20, 20));
  FeatureCurves c;
  draw(c, grid_row(s, 2, 12, 5, 20));
  measure_curves({}, s.mesh, {}, c);
  Mesh large = s.mesh;
  for (auto* x : {&large.x, &large.y, &large.z})
    for (Real& v : *x) v *= 1000;
  FeatureCurves d = c;
  for (Real& k : d.kmax) k /= 1000;
  for (Real& k : d.kmin) k /= 1000;
  for (Real& e : d.extremality) e /= 1e6;
  measure_curves({}, large, {}, d);
  CHECK(d.length[0] == doctest::Approx(1000 * c.length[0]).epsilon(1e-12));
  CHECK(d.rms_curvature[0] == doctest::Approx(c.rms_curvature[0] / 1000).epsilon(1e-12));
  CHECK(d.strength[0] == doctest::Approx(c.strength[0]).epsilon(1e-12));
}

namespace {

// A square folded along x = 0 by `turn`, with a ridge along part of the fold.
Real turn_on_fold(Real turn, Index cells, const kernels::TurnOptions& options) {
  const Real slope = -std::tan(turn / 2);
  const TestSurface s =
      make_surface(height_field(2 * cells, 2 * cells, -1, 1, -1, 1, [&](Real x, Real) { return slope * std::abs(x); }));
  FeatureCurves c;
  std::vector<Index> row;
  for (int i = -4; i <= 4; ++i) row.push_back(vertex_near(s, Vec3(0, 0.1 * i, 0)));
  draw(c, row);
  for (Index p = 0; p < c.point_count(); ++p) c.across.set(p, Vec3(1, 0, 0));
  kernels::turn_angles({}, s.mesh, s.mean_edge, options, c);
  for (Real t : c.turn()) CHECK(t == doctest::Approx(c.turn()[0]).epsilon(0.01));
  return c.turn()[4];
}

}  // namespace

TEST_CASE("the turn angle of a crease is its dihedral turn at any density, also where vertices are gathered") {
  const Real degree = std::numbers::pi / 180;
  kernels::TurnOptions wide;
  wide.radius = 0.15;
  for (const Real turn : {20.0, 60.0, 90.0, 150.0}) {
    CAPTURE(turn);
    CHECK(turn_on_fold(turn * degree, 10, {}) == doctest::Approx(turn * degree).epsilon(0.03));
    CHECK(turn_on_fold(turn * degree, 40, {}) == doctest::Approx(turn * degree).epsilon(0.03));
    CHECK(turn_on_fold(turn * degree, 40, wide) == doctest::Approx(turn * degree).epsilon(0.05));
  }
}

TEST_CASE("the turn angle of a cylinder is about 0.85 rho / r; a sharp curve stops the walk") {
  const TestSurface s = make_surface(cylinder(1, 1, 2, 120, 40));
  const Real radius = 1 / s.box.diagonal;
  FeatureCurves c;
  std::vector<Index> row;
  for (int i = 10; i <= 30; i += 5) row.push_back(vertex_near(s, Vec3(1, 0, 0.05 * i)));
  draw(c, row);
  for (Index p = 0; p < c.point_count(); ++p) c.normal.set(p, Vec3(1, 0, 0)), c.across.set(p, Vec3(0, 1, 0));
  kernels::TurnOptions options;
  options.radius = 0.06;
  kernels::turn_angles({}, s.mesh, s.mean_edge, options, c);
  for (Real t : c.turn()) CHECK(t == doctest::Approx(0.06 / radius * 1.3).epsilon(0.15));  // two sides of 0.65 rho

  std::vector<Index> fence;
  for (int i = 0; i <= 40; ++i) fence.push_back(vertex_near(s, Vec3(std::cos(0.0524), std::sin(0.0524), 0.05 * i)));
  const Real open = c.turn()[2];
  draw(c, fence, CurveKind::sharp, false, 0.123);
  kernels::turn_angles({}, s.mesh, s.mean_edge, options, c);
  CHECK(c.turn()[2] < 0.6 * open);
  CHECK(c.turn()[c.points_of(1)[3]] == 0.123);
}
