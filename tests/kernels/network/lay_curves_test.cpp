#include "kernels/network/lay_curves.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "engine/base/error.h"
#include "tests/support/surface.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

std::vector<Vec3> positions(const MeshView& mesh, const LaidCurves& laid, Index c) {
  std::vector<Vec3> p;
  for (const Index i : laid.net.curve.row(c)) p.push_back(position(mesh, laid.net.point[i]));
  return p;
}

Real length_of(const std::vector<Vec3>& p) {
  Real length = 0;
  for (std::size_t i = 1; i < p.size(); ++i) length += (p[i] - p[i - 1]).norm();
  return length;
}

bool steps_share_faces(const MeshView& mesh, const LaidCurves& laid) {
  for (Index c = 0; c < laid.net.curve_count(); ++c) {
    const auto row = laid.net.curve.row(c);
    for (std::size_t i = 1; i < row.size(); ++i) {
      const Vec3 a = position(mesh, laid.net.point[row[i - 1]]), b = position(mesh, laid.net.point[row[i]]);
      bool shared = false;
      for (Index f = 0; f < mesh.face_count() && !shared; ++f) {
        const std::array<Index, 3> corner = mesh.face(f);
        const Vec3 o = mesh.point(corner[0]), n = (mesh.point(corner[1]) - o).cross(mesh.point(corner[2]) - o);
        const auto inside = [&](const Vec3& p) {
          for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 s = mesh.point(corner[k]), t = mesh.point(corner[(k + 1) % 3]);
            if ((t - s).cross(p - s).dot(n) < -1e-9 * n.squaredNorm()) return false;
          }
          return std::abs((p - o).dot(n)) < 1e-9 * n.norm();
        };
        shared = inside(a) && inside(b);
      }
      if (!shared) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("on a plane a curve stays where it was drawn") {
  const TestSurface s = make_surface(plane(12, 9));
  const auto here = [&](Real x, Real y) { return s.box.to_unit({x, y, 0}); };
  const std::vector<std::vector<Vec3>> drawn = {{here(0.03, 0.04), here(0.91, 0.37), here(0.5, 0.93)}};
  const LaidCurves laid = lay_curves(Work(), s.view(), s.mean_edge, drawn);
  REQUIRE(laid.net.curve_count() == 1);
  CHECK(laid.net.kind[0] == CurveKind::given);
  const auto p = positions(s.view(), laid, 0);
  CHECK(length_of(p) == doctest::Approx(length_of(drawn[0])).epsilon(1e-6));
  CHECK((p.front() - drawn[0].front()).norm() < 1e-9);
  CHECK((p.back() - drawn[0].back()).norm() < 1e-9);
  CHECK(steps_share_faces(s.view(), laid));
  CHECK(laid.gaps == 0);
}

TEST_CASE("a circle drawn above a sphere becomes a closed curve of its length on the sphere") {
  const TestSurface s = make_surface(icosphere(4));
  std::vector<std::vector<Vec3>> drawn(1);
  constexpr Real kAngle = 0.6;
  for (int i = 0; i <= 24; ++i) {
    const Real a = 2 * std::numbers::pi * (i % 24) / 24;
    const Vec3 on(std::sin(kAngle) * std::cos(a), std::sin(kAngle) * std::sin(a), std::cos(kAngle));
    drawn[0].push_back(s.box.to_unit(1.03 * on));
  }
  const LaidCurves laid = lay_curves(Work(), s.view(), s.mean_edge, drawn);
  REQUIRE(laid.net.curve_count() == 1);
  CHECK(laid.net.is_closed(0));
  const Real circle = 2 * std::numbers::pi * std::sin(kAngle) / s.box.diagonal;
  CHECK(length_of(positions(s.view(), laid, 0)) == doctest::Approx(circle).epsilon(0.01));
  CHECK(laid.farthest * s.box.diagonal == doctest::Approx(0.03).epsilon(0.1));
  CHECK(steps_share_faces(s.view(), laid));
}

TEST_CASE("points on vertices and edges are taken as such") {
  const TestSurface s = make_surface(cube(4));
  const MeshView mesh = s.view();
  const auto row = mesh.vertex_vertices.row(17);
  const std::vector<std::vector<Vec3>> drawn = {{mesh.point(17), mesh.point(row[0])}};
  const LaidCurves laid = lay_curves(Work(), mesh, s.mean_edge, drawn);
  REQUIRE(laid.net.curve_count() == 1);
  REQUIRE(laid.net.curve.row(0).size() == 2);
  CHECK(laid.net.point[0] == SurfacePoint::at_vertex(17));
  CHECK(laid.net.point[1] == SurfacePoint::at_vertex(row[0]));
}

TEST_CASE("what lies in another place is refused") {
  const TestSurface s = make_surface(plane(4, 4));
  const std::vector<std::vector<Vec3>> drawn = {{Vec3(0, 0, 0), Vec3(0, 0, 0.5)}};
  CHECK_THROWS_AS(lay_curves(Work(), s.view(), s.mean_edge, drawn), Error);
}
