#include <numbers>

#include <doctest/doctest.h>

#include "tests/tools/step/pieces.h"
#include "tools/step/fit_face.h"

using namespace intarsia;
using namespace intarsia::tools;

namespace {

template <class Height>
SurfaceSamples height_samples(int n, const Height& height) {
  SurfaceSamples samples;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const Vec2 at(2.0 * i / n, 1.0 * j / n);
      samples.add(at, Vec3(at.x(), at.y(), height(at.x(), at.y())), 2.0 / (n * n));
    }
  return samples;
}

SplineDomain rectangle(int u_spans, int v_spans) { return {Vec2(0, 0), Vec2(2, 1), u_spans, v_spans}; }

Real farthest(const SplineSurface& s, const SurfaceSamples& samples) {
  Real most = 0;
  for (std::size_t k = 0; k < samples.size(); ++k)
    most = std::max(most, (s.at(samples.uv[k]).point - samples.point[k]).norm());
  return most;
}

}  // namespace

TEST_CASE("cubic weights add up to one, their slopes to nothing; clamping changes no point") {
  for (const Real at : {0.0, 0.3, 1.0, 2.7, 4.0, 5.0}) {
    const CubicWeights w = cubic_weights(at, 5);
    CHECK(w.value[0] + w.value[1] + w.value[2] + w.value[3] == doctest::Approx(1).epsilon(1e-14));
    CHECK(std::abs(w.slope[0] + w.slope[1] + w.slope[2] + w.slope[3]) < 1e-14);
  }
  const SplineCurve<Vec2> curve{2, {{0, 1}, {2, 0}, {3, 4}, {1, 1}, {0, 2}, {5, 5}}};
  const std::vector<Vec2> c = curve.clamped();
  CHECK((c.front() - curve.at(0)).norm() < 1e-14);
  CHECK((c.back() - curve.at(2)).norm() < 1e-14);
  // The end tangent of a clamped cubic: 3 (c1 - c0) / span.
  const Vec2 slope = (curve.at(1e-6) - curve.at(0)) / 1e-6;
  CHECK((3 * (c[1] - c[0]) / (2.0 / 3) - slope).norm() < 1e-5);
}

TEST_CASE("planes are reproduced exactly, smooth surfaces with the fourth power of the cells") {
  const SurfaceSamples plane = height_samples(40, [](Real x, Real y) { return 1 + 2 * x - y; });
  CHECK(farthest(fit_surface(rectangle(7, 3), plane), plane) < 1e-11);
  const SurfaceSamples wave = height_samples(120, [](Real x, Real y) { return std::sin(2 * x) * std::cos(3 * y); });
  const Real coarse = farthest(fit_surface(rectangle(8, 4), wave), wave);
  const Real fine = farthest(fit_surface(rectangle(16, 8), wave), wave);
  CHECK(coarse < 5e-3);
  CHECK(fine < coarse / 5);  // the stiffness costs a power at the border
}

TEST_CASE("where there are no samples the surface goes on tamely") {
  SurfaceSamples samples;  // a quarter of the rectangle
  for (int i = 0; i <= 30; ++i)
    for (int j = 0; j <= 30; ++j) {
      const Vec2 at(i / 30.0, j / 60.0);
      samples.add(at, Vec3(at.x(), at.y(), 0.1 * std::sin(3 * at.x())), 1e-3);
    }
  const SplineSurface s = fit_surface(rectangle(16, 8), samples);
  for (const Vec3& p : s.control) CHECK(p.norm() < 4);
}

TEST_CASE("curves go through their ends; nearest points are found") {
  std::vector<Real> t;
  std::vector<Vec3> p;
  for (int i = 0; i <= 50; ++i) t.push_back(i / 50.0), p.push_back({std::cos(t[i]), std::sin(t[i]), t[i]});
  const SplineCurve<Vec3> curve = fit_curve(t, std::span<const Vec3>(p), 6);
  CHECK((curve.at(0) - p.front()).norm() < 1e-14);
  CHECK((curve.at(1) - p.back()).norm() < 1e-14);
  for (int i = 0; i <= 50; ++i) CHECK((curve.at(t[i]) - p[i]).norm() < 1e-5);

  FaceSurface surface;
  surface.spline = fit_surface(rectangle(8, 4), height_samples(60, [](Real x, Real y) { return x * x / 4 + y / 3; }));
  const Vec2 uv(1.3, 0.4);
  const SurfacePointAndSlopes s = surface.at(uv);
  const Vec3 off = s.point + 0.1 * s.u.cross(s.v).normalized();
  CHECK((surface.nearest(off, Vec2(1, 0.5), 20) - uv).norm() < 1e-7);
}

TEST_CASE("a flat patch becomes a plane, a cylinder sector a surface within the limits") {
  FitLimits limits{1e-3, 5e-4, 1e-4};
  const PatchPiece flat = test::grid_piece(6, 6, [](Real u, Real v) { return Vec3(u, v, 1 + u + v); });
  const FittedFace plane = fit_face(flat, limits);
  REQUIRE(plane.done);
  CHECK(plane.surface.is_plane);
  CHECK(plane.inside < 1e-12);
  for (std::size_t i = 0; i < flat.point.size(); ++i)
    CHECK((plane.surface.at(plane.uv[i]).point - flat.point[i]).norm() < 1e-12);

  for (const Real angle : {1.0, 3.0, 5.0}) {
    CAPTURE(angle);
    const PatchPiece sector = test::cylinder_sector(120, 20, angle);
    const FittedFace face = fit_face(sector, limits);
    REQUIRE(face.done);
    CHECK(!face.surface.is_plane);
    CHECK(face.inside <= limits.inside);
    CHECK(face.border <= limits.border);
    for (std::size_t i = 0; i < sector.point.size(); i += 7) {
      const SurfacePointAndSlopes s = face.surface.at(face.surface.nearest(sector.point[i], face.uv[i]));
      CHECK(std::abs(std::hypot(s.point.x(), s.point.y()) - 1) < 2e-3);
      CHECK(s.u.cross(s.v).normalized().dot(Vec3(sector.point[i].x(), sector.point[i].y(), 0)) > 0.99);  // outwards
    }
  }
}
