#include "kernels/surface/normals.h"

#include <numbers>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "tests/support/surface.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

Real total_area(const TestSurface& s) {
  Real area = 0;
  for (Real a : s.faces.area) area += a;
  return area * s.box.diagonal * s.box.diagonal;
}

}  // namespace

TEST_CASE("edge counts and Euler characteristics") {
  const auto euler = [](const TestSurface& s) {
    return int(s.mesh.vertex_count()) - int(s.mesh.edge_count()) + int(s.mesh.face_count());
  };
  const TestSurface sphere = make_surface(icosphere(3));
  CHECK(sphere.mesh.vertex_count() == 642);
  CHECK(sphere.mesh.edge_count() == 1920);
  CHECK(euler(sphere) == 2);
  CHECK(euler(make_surface(torus(3, 1, 24, 12))) == 0);
  CHECK(euler(make_surface(cylinder(1, 1, 2, 24, 12))) == 0);
  CHECK(euler(make_surface(plane(5, 4))) == 1);
  CHECK(make_surface(plane(5, 4)).mesh.edge_count() == 5 * 5 + 4 * 6 + 5 * 4);
  CHECK(euler(make_surface(joined(cube(3), icosphere(1)))) == 4);
}

TEST_CASE("areas") {
  CHECK(total_area(make_surface(cube(7))) == doctest::Approx(6).epsilon(1e-13));
  CHECK(total_area(make_surface(plane(6, 9, Diagonals::alternating))) == doctest::Approx(1).epsilon(1e-13));
  const Real coarse = 4 * std::numbers::pi - total_area(make_surface(icosphere(3)));
  const Real fine = 4 * std::numbers::pi - total_area(make_surface(icosphere(4)));
  CHECK(coarse > 0);
  CHECK(coarse / fine == doctest::Approx(4).epsilon(0.01));  // second order
}

TEST_CASE("face normals and centroids of a cube") {
  const TestSurface s = make_surface(cube(3));
  for (Index f = 0; f < s.mesh.face_count(); ++f) {
    const Vec3 n = s.faces.normal[f], c = s.faces.centroid[f];
    CHECK(n.cwiseAbs().maxCoeff() == doctest::Approx(1).epsilon(1e-14));
    CHECK(n.dot(c) == doctest::Approx(0.5 / std::sqrt(3.0)).epsilon(1e-13));  // outward, on its side
  }
}

TEST_CASE("vertex normals are exact on spheres, however irregular") {
  const Soup soup = jittered(icosphere(4), 0.02, 3, [](const Vec3&, const Vec3& p) { return Vec3(p.normalized()); });
  const TestSurface s = make_surface(soup);
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) CHECK((s.vertex_normal[v] - s.input_point(v)).norm() < 1e-10);
}

TEST_CASE("vertex normals of an ellipsoid converge") {
  const auto rms = [](int level) {
    const TestSurface s = make_surface(ellipsoid(level, 3, 2, 1));
    Real error = 0;
    for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
      const Vec3 p = s.input_point(v), gradient(p.x() / 9, p.y() / 4, p.z());
      error += (s.vertex_normal[v] - gradient.normalized()).squaredNorm();
    }
    return std::sqrt(error / s.mesh.vertex_count());
  };
  const Real coarse = rms(3), fine = rms(4);
  CHECK(coarse < 0.02);
  CHECK(coarse / fine > 3);
}

TEST_CASE("vertex normals on lines of curvature of a torus") {
  const TestSurface s = make_surface(torus(2, 1, 64, 32));
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
    const Vec3 p = s.input_point(v), ring = 2 * Vec3(p.x(), p.y(), 0).normalized();
    CHECK((s.vertex_normal[v] - (p - ring).normalized()).norm() < 1e-3);
  }
}

TEST_CASE("flat faces have no normal and do no harm") {
  Soup soup = plane(6, 6);
  const Index mid = 24;  // the middle of the grid
  soup.x[mid] = soup.x[mid + 1], soup.y[mid] = soup.y[mid + 1];
  const Index lone = add_vertex(soup, {3, 3, 0});
  add_vertex(soup, {4, 3, 0}), add_vertex(soup, {5, 3, 0});
  add_face(soup, lone, lone + 1, lone + 2);  // a component without any area
  const TestSurface s = make_surface(soup);
  Index flat = 0;
  for (Index f = 0; f < s.mesh.face_count(); ++f) {
    const bool none = s.faces.area[f] == 0;
    flat += none;
    CHECK(s.faces.normal[f].norm() == doctest::Approx(none ? 0 : 1));
    CHECK(s.faces.centroid[f].allFinite());
  }
  CHECK(flat == 3);  // the two faces of the vanished edge and the needle
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) CHECK(s.vertex_normal[v].norm() == doctest::Approx(1));
}

TEST_CASE("mean edge length") {
  const TestSurface s = make_surface(plane(4, 4));
  const Real straight = 2 * 4 * 5 * 0.25, diagonal = 16 * 0.25 * std::sqrt(2.0);
  CHECK(s.mean_edge * s.box.diagonal == doctest::Approx((straight + diagonal) / 56).epsilon(1e-14));
}

TEST_CASE("reversing a surface reverses its normals") {
  const TestSurface a = make_surface(cube(4)), b = make_surface(reversed(cube(4)));
  for (Index v = 0; v < a.mesh.vertex_count(); ++v) {
    CHECK(a.point(v) == b.point(v));
    CHECK((a.vertex_normal[v] + b.vertex_normal[v]).norm() < 1e-15);
  }
}
