// STEP files of shapes with known truth, as OpenCASCADE's own reader sees them.
#include <doctest/doctest.h>

#include "tests/tools/step/labelled.h"
#include "tools/step/cad_shape.h"
#include "tools/step/fit_layout.h"

#ifdef INTARSIA_HAS_OPENCASCADE

using namespace intarsia;
using namespace intarsia::tools;

namespace {

struct ReadBack {
  CadCheck check;
  CadTriangles triangles;
};

ReadBack written_and_read(const test::Labelled& shape, Real tolerance) {
  const LayoutFit fit = fit_layout({}, shape.refined.mesh, shape.label, shape.graph, tolerance);
  const CadShape built(fit.model, Vec3(3, -2, 1), 10);
  const CadShape read = CadShape::read_step_text(built.step_text("shape", CadUnit::millimetre, "test"));
  ReadBack out{read.check(), read.triangulate(tolerance)};
  for (std::size_t i = 0; i < out.triangles.x.size(); ++i)
    out.triangles.x[i] = (out.triangles.x[i] - 3) / 10, out.triangles.y[i] = (out.triangles.y[i] + 2) / 10,
    out.triangles.z[i] = (out.triangles.z[i] - 1) / 10;
  out.check.volume /= 1000, out.check.area /= 100;
  return out;
}

void check_solid(const CadCheck& c, Index faces) {
  INFO(c.trouble);
  CHECK(c.valid);
  CHECK(c.solids == 1);
  CHECK(c.shells == 1);
  CHECK(c.faces == faces);
  CHECK(c.free_edges == 0);
  CHECK(c.degenerate_edges == 0);
}

// A profile (radius, height) turned about z, with a pole at both ends.
Soup turned(const std::vector<Vec2>& profile, Index around, Index steps) {
  std::vector<Vec2> at;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    for (Index k = 0; k < steps; ++k) at.push_back(profile[i] + (profile[i + 1] - profile[i]) * k / Real(steps));
  at.erase(at.begin());
  Soup s;
  const Index low = test::add_vertex(s, {0, 0, profile.front().y()});
  for (const Vec2& p : at)
    for (Index k = 0; k < around; ++k) {
      const Real angle = 2 * 3.14159265358979323846 * k / around;
      test::add_vertex(s, {p.x() * std::cos(angle), p.x() * std::sin(angle), p.y()});
    }
  const Index high = test::add_vertex(s, {0, 0, profile.back().y()});
  const auto id = [&](std::size_t ring, Index k) { return static_cast<Index>(1 + ring * around + k % around); };
  for (Index k = 0; k < around; ++k) {
    test::add_face(s, low, id(0, k + 1), id(0, k));
    for (std::size_t r = 0; r + 1 < at.size(); ++r) {
      test::add_face(s, id(r, k), id(r, k + 1), id(r + 1, k + 1));
      test::add_face(s, id(r, k), id(r + 1, k + 1), id(r + 1, k));
    }
    test::add_face(s, high, id(at.size() - 1, k), id(at.size() - 1, k + 1));
  }
  return s;
}

}  // namespace

TEST_CASE("step file: a turned shape with a cylinder, a cone and a face with a hole, closed when read back") {
  const std::vector<Vec2> profile = {{0, 0}, {1, 0}, {1, 1}, {0.6, 1}, {0.3, 2}, {0, 2}};
  const test::Labelled shape = test::labelled(turned(profile, 96, 12), [](const Vec3& p, const Vec3& n) -> Index {
    if (n.z() < -0.9) return 0;
    if (n.z() > 0.9) return p.z() > 1.5 ? 1 : 2;
    return p.z() < 1 ? 3 : 4;
  });
  REQUIRE(shape.graph.patch_count() == 5);
  const Real tolerance = 0.005;
  const ReadBack read = written_and_read(shape, tolerance);
  check_solid(read.check, 5);
  const Real pi = 3.14159265358979323846;
  CHECK(std::abs(read.check.volume - pi * (1 + 0.21)) < tolerance * read.check.area);
  // Radius and height from the nearest part of the profile.
  for (std::size_t i = 0; i < read.triangles.x.size(); ++i) {
    const Vec2 p(std::hypot(read.triangles.x[i], read.triangles.y[i]), read.triangles.z[i]);
    Real nearest = 1;
    for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
      const Vec2 way = profile[k + 1] - profile[k];
      const Real s = std::clamp((p - profile[k]).dot(way) / way.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (p - profile[k] - s * way).norm());
    }
    REQUIRE(nearest < tolerance);
  }
}

TEST_CASE("step file: a ball in a belt with two round holes and two caps, closed when read back") {
  const test::Labelled ball = test::labelled(test::icosphere(5), [](const Vec3& p, const Vec3&) -> Index {
    return p.z() > 0.6 ? 0 : p.z() < -0.7 ? 1 : 2;
  });
  REQUIRE(ball.graph.patch_count() == 3);
  const Real tolerance = 0.006;
  const ReadBack read = written_and_read(ball, tolerance);
  check_solid(read.check, 3);
  for (std::size_t i = 0; i < read.triangles.x.size(); ++i)
    REQUIRE(std::abs(Vec3(read.triangles.x[i], read.triangles.y[i], read.triangles.z[i]).norm() - 1) < tolerance);
}

TEST_CASE("step file: a bumpy ball in many parts of uneven size, closed when read back") {
  // Corners where three or four parts meet, arcs of every length down to single edges of the mesh.
  const Soup bumpy = test::transformed(test::icosphere(5), [](const Vec3& p) -> Vec3 {
    return (1 + 0.08 * std::sin(5 * p.x()) * std::cos(4 * p.y() + p.z())) * p;
  });
  const test::Labelled shape = test::labelled(bumpy, [](const Vec3& p, const Vec3&) -> Index {
    const Real a = p.x() + 0.2 * std::sin(3 * p.z()), b = p.y() - 0.1 * std::cos(4 * p.x());
    return (a > 0.1 ? 1u : 0u) + (b > -0.05 ? 2u : 0u) + (p.z() > 0.12 ? 4u : 0u) + (a + b + p.z() > 0.9 ? 8u : 0u);
  });
  const ReadBack read = written_and_read(shape, 0.007);
  check_solid(read.check, shape.graph.patch_count());
}

#endif
