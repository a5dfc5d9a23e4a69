#include "kernels/curvature/compute_curvature.h"

#include <cmath>
#include <set>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "kernels/ridges/edge_crossings.h"
#include "kernels/scale/compute_scale.h"
#include "tests/support/raw_mesh.h"
#include "tests/support/rounded_cube.h"
#include "tests/support/surface.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

// Curvature in the units of the mesh, whose diagonal is 1.
CurvatureFields fields_of(const TestSurface& s, const ScaleOptions& scale = {}, const CurvatureOptions& options = {}) {
  const ScaleFields f = compute_scale(Work{}, s.mesh, scale);
  return compute_curvature(Work{}, s.mesh, s.vertex_normal, f.fit_ring, f.levels, {}, options);
}

CurvatureFields fields_in_ring(const TestSurface& s, std::uint8_t ring) {
  const std::vector<std::uint8_t> rings(s.mesh.vertex_count(), ring);
  return compute_curvature(Work{}, s.mesh, s.vertex_normal, rings, {}, {}, {});
}

Index ridge_points(const TestSurface& s, const CurvatureFields& f, CurveKind kind) {
  return edge_crossings(Work{}, s.mesh, CrestFields(f, kind), {}, {}).size();
}

}  // namespace

TEST_CASE("sphere: both curvatures 1/R, no direction, no ridge") {
  const TestSurface s = make_surface(icosphere(4));
  const Real radius = 1 / s.box.diagonal;
  for (int mode = 0; mode < 2; ++mode) {
    const CurvatureFields f = mode ? fields_of(s, ScaleOptions::paper(), CurvatureOptions::paper()) : fields_of(s);
    for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
      CHECK(f.kmax[v] * radius == doctest::Approx(1).epsilon(0.01));
      CHECK(f.kmin[v] * radius == doctest::Approx(1).epsilon(0.01));
      CHECK(std::abs(f.emax[v]) * s.mean_edge * s.mean_edge < 1e-4);
      CHECK(f.status[v] == FitStatus::full);
      CHECK((f.normal[v] - s.point(v).normalized()).norm() < 1e-3);
    }
    CHECK(ridge_points(s, f, CurveKind::ridge) == 0);
    CHECK(ridge_points(s, f, CurveKind::valley) == 0);
  }
}

TEST_CASE("cylinder: 1/R around, 0 along") {
  const TestSurface s = make_surface(cylinder(1, 1, 3, 96, 46));
  const CurvatureFields f = fields_of(s);
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
    const Vec3 p = s.input_point(v);
    if (p.z() < 0.5 || p.z() > 2.5) continue;
    CHECK(f.kmax[v] * (1 / s.box.diagonal) == doctest::Approx(1).epsilon(0.003));
    CHECK(std::abs(f.kmin[v]) / s.box.diagonal < 0.003);
    CHECK(std::abs(f.tmax[v].z()) < 0.01);
    CHECK(f.direction_ok[v] == 1);
    CHECK(std::abs(f.emax[v]) * f.radius[v] * f.radius[v] < 1e-4);
  }
}

TEST_CASE("torus: curvatures in closed form, small extremality") {
  const TestSurface s = make_surface(torus(2, 1, 96, 48));
  const CurvatureFields f = fields_of(s);
  const Real d = s.box.diagonal;
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
    const Vec3 p = s.input_point(v);
    const Real cosine = std::hypot(p.x(), p.y()) - 2;
    CHECK(f.kmax[v] / d == doctest::Approx(1).epsilon(0.02));
    CHECK(std::abs(f.kmin[v] / d - cosine / (2 + cosine)) < 0.03);
    CHECK(std::abs(f.emax[v]) / (d * d) < 0.05);
  }
}

TEST_CASE("ellipsoid 3:2:1 with irregular sampling, three rings: ridge points on its loop only") {
  const auto onto = [](const Vec3&, const Vec3& q) {
    return Vec3(q / std::sqrt(q.x() * q.x() / 9 + q.y() * q.y() / 4 + q.z() * q.z()));
  };
  const TestSurface s = make_surface(jittered(ellipsoid(5, 3, 2, 1), 0.015, 4, onto));
  const CurvatureFields f = fields_in_ring(s, 3);
  const EdgeCrossings c = edge_crossings(Work{}, s.mesh, CrestFields(f, CurveKind::ridge), {}, {});
  CHECK(c.size() > 100);
  for (Index i = 0; i < c.size(); ++i) {
    const Vec3 a = s.input_point(s.mesh.edge_v0[c.edge[i]]), b = s.input_point(s.mesh.edge_v1[c.edge[i]]);
    CHECK(std::abs(((1 - c.position[i]) * a + c.position[i] * b).z()) < 0.08);
  }
}

TEST_CASE("a rotated, translated plane has no directions") {
  const TestSurface s = make_surface(transformed(plane(30, 30), [](const Vec3& p) {
    return Vec3(Eigen::AngleAxisd(0.9, Vec3(1, 3, 2).normalized()) * p + Vec3(1, 2, 3));
  }));
  const CurvatureFields f = fields_of(s);
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
    CHECK(std::abs(f.kmax[v]) * f.radius[v] < 1e-9);
    CHECK(f.direction_ok[v] == 0);
  }
  CHECK(ridge_points(s, f, CurveKind::ridge) == 0);
}

TEST_CASE("the reversed surface has the mapped fields") {
  const Soup soup = jittered(
      height_field(24, 24, -1, 1, -1, 1, [](Real x, Real y) { return 0.3 * x * x * x - 0.5 * y * y + 0.2 * x * y; }),
      0.02, 8);
  const TestSurface a = make_surface(soup), b = make_surface(reversed(soup));
  REQUIRE(a.mesh.x == b.mesh.x);
  const CurvatureFields f = fields_in_ring(a, 2), g = fields_in_ring(b, 2);
  for (Index v = 0; v < a.mesh.vertex_count(); ++v) {
    CHECK((f.normal[v] + g.normal[v]).norm() < 1e-12);
    if (f.status[v] != FitStatus::full) continue;
    const Real r = f.radius[v];
    CHECK(std::abs(f.kmax[v] + g.kmin[v]) * r < 1e-11);
    CHECK(std::abs(f.kmin[v] + g.kmax[v]) * r < 1e-11);
    if (!f.direction_ok[v]) continue;
    const Real sign = f.tmax[v].dot(g.tmin[v]) > 0 ? 1 : -1;
    CHECK((f.tmax[v] - sign * g.tmin[v]).norm() < 1e-9);
    CHECK(std::abs(f.emax[v] + sign * g.emin[v]) * r * r < 1e-9);
  }
}

TEST_CASE("rotating the surface rotates the fields") {
  const Soup soup = jittered(ellipsoid(3, 3, 2, 1), 0.03, 9);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vec3(2, -1, 1).normalized()).toRotationMatrix();
  const Mesh m = raw_mesh(soup), t = raw_mesh(transformed(soup, [&](const Vec3&p) { return Vec3(turn * p); }));
  const auto fields = [](const Mesh& mesh) {
    const std::vector<std::uint8_t> rings(mesh.vertex_count(), 3);
    const Vec3Array n = vertex_normals(Work{}, mesh, face_geometry(Work{}, mesh));
    return compute_curvature(Work{}, mesh, n, rings, {}, {}, {});
  };
  const CurvatureFields f = fields(m), g = fields(t);
  for (Index v = 0; v < m.vertex_count(); ++v) {
    CHECK(g.kmax[v] == doctest::Approx(f.kmax[v]).epsilon(1e-9));
    CHECK((turn * f.normal[v] - g.normal[v]).norm() < 1e-12);
    CHECK(std::abs(std::abs(f.emax[v]) - std::abs(g.emax[v])) < 1e-8);
    CHECK(std::abs(f.tmax[v].dot(f.normal[v])) < 1e-14);
    CHECK(f.tmax[v].norm() == doctest::Approx(1));
    CHECK((f.tmax[v].cross(f.tmin[v]) - f.normal[v]).norm() < 1e-14);
  }
}

TEST_CASE("one ridge along each fillet of a rounded cube, at 2, 4, 8 and 16 edges") {
  const std::array<std::array<Real, 2>, 4> shapes{{{16, 2}, {16, 4}, {48, 8}, {75, 16}}};
  for (const auto& shape : shapes) {
    const Real half = shape[0], radius = shape[1];
    CAPTURE(radius);
    const RoundedCube cube{half, radius};
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const TestSurface s = make_surface(transformed(cube.mesh(0.2, 3), [&](const Vec3& p) { return Vec3(turn * p); }));
    const CurvatureFields f = fields_of(s);
    const EdgeCrossings c = edge_crossings(Work{}, s.mesh, CrestFields(f, CurveKind::ridge), {}, {});
    Index off = 0;
    std::set<std::array<int, 3>> met;  // fillet and stretches of 3 edges along it
    for (Index i = 0; i < c.size(); ++i) {
      const Vec3 a = s.input_point(s.mesh.edge_v0[c.edge[i]]), b = s.input_point(s.mesh.edge_v1[c.edge[i]]);
      const Vec3 p = turn.transpose() * ((1 - c.position[i]) * a + c.position[i] * b);
      if (cube.rounded_axes(p) != 2) continue;
      int along;
      (p - cube.inner(p)).cwiseAbs().minCoeff(&along);
      if (std::abs(p[along]) > 0.7 * half) continue;  // near the corners three lines meet
      if (std::abs(cube.from_middle(p)) > 1.5) ++off;
      const int side = 2 * (p[(along + 1) % 3] > 0) + (p[(along + 2) % 3] > 0);
      met.insert({along, side, static_cast<int>(std::floor(p[along] / 3))});
    }
    CHECK(off == 0);
    const int last = static_cast<int>(std::floor(0.6 * half / 3));
    for (int along = 0; along < 3; ++along)
      for (int side = 0; side < 4; ++side)
        for (int at = -last; at < last; ++at) CHECK(met.count({along, side, at}) == 1);
  }
}

TEST_CASE("fields do not depend on threads, and no value is undefined on degenerate input") {
  const TestSurface s = make_surface(RoundedCube{20, 6}.mesh(0.2, 3));
  const auto run = [&] { return fields_of(s); };
  const CurvatureFields one = run_with_threads(1, run), three = run_with_threads(3, run);
  CHECK(one.kmax == three.kmax);
  CHECK(one.emax == three.emax);
  CHECK(one.emin == three.emin);
  CHECK(one.tmax.x == three.tmax.x);
  CHECK(one.normal.z == three.normal.z);
  CHECK(one.ring == three.ring);

  Soup odd = plane(3, 3);
  const Index a = add_vertex(odd, Vec3(0.5, 0.5, 0)), b = add_vertex(odd, Vec3(0.5, 0.5, 0));
  add_face(odd, 5, a, b);
  const Mesh m = raw_mesh(odd);
  const ScaleFields scale = compute_scale(Work{}, m, {});
  const Vec3Array n = vertex_normals(Work{}, m, face_geometry(Work{}, m));
  const CurvatureFields f = compute_curvature(Work{}, m, n, scale.fit_ring, scale.levels, {}, {});
  for (Index v = 0; v < m.vertex_count(); ++v)
    for (Real value : {f.kmax[v], f.kmin[v], f.emax[v], f.emin[v], f.radius[v], f.tmax[v].sum(), f.normal[v].sum()})
      CHECK(std::isfinite(value));
}
