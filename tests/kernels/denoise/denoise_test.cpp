#include "kernels/denoise/denoise.h"

#include <cmath>

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "kernels/denoise/fit_positions.h"
#include "kernels/denoise/roughness.h"
#include "tests/support/surface.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

// Gaussian displacements of sigma mean edges in all directions.
Soup noisy(const Soup& soup, Real sigma, std::uint64_t seed = 3) {
  const TestSurface s = make_surface(soup);
  const Real step = sigma * s.mean_edge * s.box.diagonal;
  const Random random(seed, 0);
  Soup out = soup;
  for (Index v = 0; v < out.vertex_count(); ++v)
    out.x[v] += step * random.normal(v, 0), out.y[v] += step * random.normal(v, 1),
        out.z[v] += step * random.normal(v, 2);
  return out;
}

Real roughness_of(const TestSurface& s) { return roughness({}, s.mesh, s.faces.normal); }

Real distance_to_cube(const Vec3& p, Real half) {  // of the surface
  const Vec3 out = p.cwiseAbs() - Vec3::Constant(half);
  const Real inside = out.maxCoeff();
  return inside <= 0 ? -inside : out.cwiseMax(0).norm();
}

Real half_of(const Soup& cube) {
  Real most = 0;
  for (const Real x : cube.x) most = std::max(most, std::abs(x));
  return most;
}

Soup centred_cube(Index n) {
  Soup s = cube(n);
  Vec3 low = Vec3::Constant(1e9), high = -low;
  for (Index v = 0; v < s.vertex_count(); ++v)
    low = low.cwiseMin(test::point(s, v)), high = high.cwiseMax(test::point(s, v));
  const Vec3 middle = (low + high) / 2;
  for (Index v = 0; v < s.vertex_count(); ++v) s.x[v] -= middle.x(), s.y[v] -= middle.y(), s.z[v] -= middle.z();
  return s;
}

}  // namespace

TEST_CASE("roughness: nothing on flat faces, little on a sphere, in proportion to small noise") {
  CHECK(roughness_of(make_surface(plane(20, 20))) < 2e-3);
  CHECK(roughness_of(make_surface(cube(12))) < 2e-3);
  CHECK(roughness_of(make_surface(icosphere(3))) < 0.02);
  const Real a = roughness_of(make_surface(noisy(plane(60, 60, Diagonals::alternating), 0.05)));
  const Real b = roughness_of(make_surface(noisy(plane(60, 60, Diagonals::alternating), 0.1)));
  CHECK(b / a == doctest::Approx(2).epsilon(0.1));
  CHECK(b > 0.1);
  CHECK(b < 0.2);
}

TEST_CASE("what is not noisy stays as it is") {
  const TestSurface s = make_surface(cube(12));
  CHECK_FALSE(denoise({}, s.mesh, roughness_of(s), s.mean_edge, {}).has_value());
  const TestSurface round = make_surface(icosphere(2));
  CHECK_FALSE(denoise({}, round.mesh, roughness_of(round), round.mean_edge, {}).has_value());
}

TEST_CASE("a noisy cube gets its flat faces and sharp edges back") {
  const Soup truth = centred_cube(24);
  const Real half = half_of(truth);
  for (const Real sigma : {0.2, 0.3}) {
    CAPTURE(sigma);
    const TestSurface s = make_surface(noisy(truth, sigma));
    const auto position = denoise({}, s.mesh, roughness_of(s), s.mean_edge, {});
    REQUIRE(position.has_value());
    Real before = 0, after = 0;
    for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
      before += std::pow(distance_to_cube(s.box.to_input(s.mesh.view().point(v)), half), 2);
      after += std::pow(distance_to_cube(s.box.to_input((*position)[v]), half), 2);
    }
    CHECK(std::sqrt(after / before) < 0.5);
    Mesh mesh = s.mesh;
    mesh.x = position->x, mesh.y = position->y, mesh.z = position->z;
    const FaceGeometry faces = face_geometry({}, mesh);
    Real along_axes = 0, all = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      all += faces.area[f];
      if (faces.normal[f].cwiseAbs().maxCoeff() > std::cos(0.1)) along_axes += faces.area[f];
    }
    CHECK(along_axes / all > 0.9);
  }
}

TEST_CASE("positions fit given normals and go no farther than allowed") {
  const TestSurface s = make_surface(noisy(plane(30, 30), 0.2));
  Vec3Array up(s.mesh.face_count()), position(s.mesh.vertex_count());
  for (Index f = 0; f < s.mesh.face_count(); ++f) up.set(f, Vec3::UnitZ());
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) position.set(v, s.mesh.view().point(v));
  const auto spread = [&] {
    Real sum = 0;
    for (const Real z : position.z) sum += z * z;
    return std::sqrt(sum / position.z.size());
  };
  const Real before = spread();
  fit_positions({}, s.mesh, up, 60, 10 * s.mean_edge, position);
  CHECK(spread() < 0.3 * before);
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) CHECK(position.x[v] == doctest::Approx(s.mesh.x[v]).epsilon(1e-12));
  const Real reach = 0.05 * s.mean_edge;
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) position.set(v, s.mesh.view().point(v));
  fit_positions({}, s.mesh, up, 20, reach, position);
  for (Index v = 0; v < s.mesh.vertex_count(); ++v)
    CHECK((position[v] - s.mesh.view().point(v)).norm() <= reach * (1 + 1e-12));
}

TEST_CASE("the same bits on any number of threads") {
  const TestSurface s = make_surface(noisy(cube(30), 0.3));
  const auto x = [&](int threads) {
    return run_with_threads(threads, [&] { return denoise({}, s.mesh, roughness_of(s), s.mean_edge, {})->x; });
  };
  const std::vector<Real> one = x(1);
  CHECK(x(2) == one);
  CHECK(x(5) == one);
}
