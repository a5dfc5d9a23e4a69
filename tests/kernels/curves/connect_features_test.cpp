#include "kernels/curves/connect_features.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "kernels/curvature/compute_curvature.h"
#include "kernels/curves/tidy_curves.h"
#include "kernels/ridges/sharp_edges.h"
#include "kernels/ridges/trace_ridges.h"
#include "kernels/scale/compute_scale.h"
#include "tests/kernels/curves/curve_case.h"
#include "tests/support/quadric_fields.h"

using namespace intarsia;
using namespace intarsia::test;
using kernels::connect_features;
using kernels::filter_by_saliency;

namespace {

FeatureCurves features_of(const TestSurface& s, const CurvatureFields& f, const kernels::CurveOptions& options = {}) {
  const auto sharp = kernels::sharp_edges({}, s.mesh, s.mean_edge, {});
  const auto ridges = kernels::trace_ridges({}, s.mesh, f, CurveKind::ridge, sharp.near_convex, {});
  const auto valleys = kernels::trace_ridges({}, s.mesh, f, CurveKind::valley, sharp.near_concave, {});
  return connect_features({}, s.mesh, s.mean_edge, ridges, valleys, sharp.curves, options);
}

CurvatureFields measured_fields(const TestSurface& s) {
  const auto scale = kernels::compute_scale({}, s.mesh, {});
  return kernels::compute_curvature({}, s.mesh, s.vertex_normal, scale.fit_ring, scale.levels, {}, {});
}

Index kept(const TestSurface& s) {
  return filter_by_saliency({}, features_of(s, measured_fields(s)), 0.04).curve_count();
}

Soup turned_ellipsoid(int level) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return transformed(icosphere(level), [&](const Vec3& p) -> Vec3 { return Vec3(3, 2, 1).cwiseProduct(turn * p); });
}

}  // namespace

TEST_CASE("the ridge of an ellipsoid stands out, by exact fields and by fitted ones") {
  const TestSurface s = make_surface(turned_ellipsoid(4));
  for (const bool exact : {true, false}) {
    CAPTURE(exact);
    const FeatureCurves all = features_of(s, exact ? quadric_fields(s, Vec3(3, 2, 1)) : measured_fields(s));
    const FeatureCurves curves = filter_by_saliency({}, all, 0.04);
    REQUIRE(curves.curve_count() == 1);
    CHECK(curves.net.is_closed(0));
    CHECK(curves.length[0] * s.box.diagonal == doctest::Approx(15.865).epsilon(0.005));
    // Between the values at the ends of the axes, in input units.
    CHECK(curves.rms_curvature[0] / s.box.diagonal > 1.423);
    CHECK(curves.rms_curvature[0] / s.box.diagonal < 2.187);
    CHECK(filter_by_saliency({}, all, 1.01 * all.component_saliency[0]).curve_count() == 0);
  }
}

TEST_CASE("nothing stands out on spheres, planes, tubes and tori, also with noise") {
  CHECK(kept(make_surface(icosphere(4))) == 0);
  CHECK(kept(make_surface(plane(40, 40))) == 0);
  CHECK(kept(make_surface(torus(2, 1, 96, 48))) == 0);
  CHECK(kept(make_surface(torus(2, 0.4, 160, 32))) == 0);
  CHECK(kept(make_surface(cylinder(1, 1, 8, 40, 60))) == 0);
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const TestSurface clean = make_surface(icosphere(4));
    const Random random(seed, 9);
    Soup noisy = icosphere(4);
    const Real amount = 0.1 * clean.mean_edge * clean.box.diagonal;
    for (Index v = 0; v < noisy.vertex_count(); ++v) {
      const Real r = 1 + amount * random.normal(v);
      noisy.x[v] *= r, noisy.y[v] *= r, noisy.z[v] *= r;
    }
    CHECK(kept(make_surface(noisy)) == 0);
  }
}

TEST_CASE("a cube has its twelve edges and nothing else, at any threshold") {
  const TestSurface s = make_surface(cube(10));
  const FeatureCurves all = features_of(s, measured_fields(s));
  for (const Real threshold : {0.0, 0.04, 1e9}) {
    const FeatureCurves curves = filter_by_saliency({}, all, threshold);
    CHECK(curves.curve_count() == 12);
    CHECK(std::count(curves.net.kind.begin(), curves.net.kind.end(), CurveKind::sharp) == 12);
  }
  CHECK(std::all_of(all.component.begin(), all.component.end(), [&](Index c) { return c == all.component[0]; }));
}

TEST_CASE("components are judged as a whole") {
  const TestSurface s = make_surface(plane(40, 40));
  FeatureCurves c;
  draw(c, grid_row(s, 2, 22, 5, 40), CurveKind::ridge, false, 0.5);    // fine
  draw(c, grid_row(s, 2, 22, 10, 40), CurveKind::ridge, false, 0.25);  // turns too little
  draw(c, grid_row(s, 2, 22, 15, 40), CurveKind::valley, true, 0.5);   // not sharp enough
  draw(c, grid_row(s, 2, 3, 20, 40), CurveKind::ridge, false, 2);      // too short
  draw(c, grid_row(s, 2, 22, 25, 40), CurveKind::ridge, false, 0.4);   // two that meet: judged together
  draw(c, grid_row(s, 22, 38, 25, 40), CurveKind::ridge, false, 0.25, c.points_of(4).back());
  draw(c, grid_row(s, 2, 4, 30, 40), CurveKind::sharp, false, 0.1);  // always
  for (Index p : c.points_of(2)) c.sharpness[p] = 0.1;
  kernels::measure_curves({}, s.mesh, {}, c);
  kernels::rank_components({}, {}, c);
  CHECK(c.component == std::vector<Index>{0, 1, 2, 3, 4, 4, 5});
  const FeatureCurves some = filter_by_saliency({}, c, 0.01);
  CHECK(some.component == std::vector<Index>{0, 4, 4, 5});
  CHECK(c.component_saliency[4] == doctest::Approx(c.saliency[4] + c.saliency[5]));
  CHECK(filter_by_saliency({}, c, 100).component == std::vector<Index>{5});
  CHECK(filter_by_saliency({}, c, c.component_saliency[0]).component == std::vector<Index>{0, 4, 4, 5});
}

TEST_CASE("the paper's order: length, then joining, then curvature and strength") {
  const TestSurface s = make_surface(plane(40, 40));
  FeatureCurves c, none;
  none.net.curve.offset.push_back(0);
  draw(c, grid_row(s, 2, 12, 5, 40));   // kept
  draw(c, grid_row(s, 14, 24, 5, 40));  // joined to it
  draw(c, grid_row(s, 2, 3, 20, 40));   // too short
  draw(c, grid_row(s, 2, 12, 30, 40));  // too flat
  for (Real& e : c.extremality) e = 30;
  for (Real& k : c.kmax) k = 40;
  for (Index p : c.points_of(3)) c.kmax[p] = 1;
  const auto out = connect_features({}, s.mesh, s.mean_edge, c, none, none, kernels::paper_curve_options());
  REQUIRE(out.curve_count() == 1);
  CHECK(out.length[0] == doctest::Approx(22.0 / 40 / s.box.diagonal));
  CHECK(filter_by_saliency({}, out, 0).curve_count() == 1);
}

TEST_CASE("the same bits for one and three threads") {
  const TestSurface s = make_surface(jittered(turned_ellipsoid(4), 0.03, 5));
  const CurvatureFields f = measured_fields(s);
  const auto one = run_with_threads(1, [&] { return features_of(s, f); });
  const auto three = run_with_threads(3, [&] { return features_of(s, f); });
  CHECK(one.curve_count() > 1);
  CHECK(one.net.point == three.net.point);
  CHECK(one.net.curve == three.net.curve);
  CHECK(one.turn() == three.turn());
  CHECK(one.saliency == three.saliency);
  CHECK(one.component_saliency == three.component_saliency);
}
