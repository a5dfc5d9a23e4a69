#include "kernels/baselines/quadric.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "engine/base/random.h"

using namespace intarsia;
using namespace intarsia::kernels;

namespace {

constexpr Real kPi = std::numbers::pi;

// Points with normals at 400 random (u, v) in the unit square, in a frame turned and moved away from the origin.
using Place = std::function<std::pair<Vec3, Vec3>(Real u, Real v)>;
std::vector<QuadricSample> samples_of(const Place& place) {
  const Random random(7, 1);
  const Eigen::AngleAxisd turn(0.8, Vec3(1, 2, -0.5).normalized());
  std::vector<QuadricSample> samples;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const auto [p, n] = place(random.uniform(i, 0), random.uniform(i, 1));
    const Vec3 at = turn * p + Vec3(3, -2, 1);
    samples.push_back({{at, at, at}, turn * n, 0.5 + random.uniform(i, 2)});
  }
  return samples;
}

std::pair<Vec3, Vec3> on_plane(Real u, Real v) { return {Vec3(u, v, 0), Vec3::UnitZ()}; }
std::pair<Vec3, Vec3> on_sphere(Real u, Real v) {
  const Real z = 0.2 + 0.7 * v, r = std::sqrt(1 - z * z);
  const Vec3 n(r * std::cos(2 * u), r * std::sin(2 * u), z);
  return {2.5 * n, n};
}
std::pair<Vec3, Vec3> on_cylinder(Real u, Real v) {
  const Vec3 n(std::cos(2 * u), std::sin(2 * u), 0);
  return {0.7 * n + Vec3(0, 0, 2 * v), n};
}
std::pair<Vec3, Vec3> on_cone(Real u, Real v) {  // half-angle 30 degrees
  const Real h = 0.5 + v, c = std::cos(kPi / 6), s = std::sin(kPi / 6);
  const Vec3 out(std::cos(3 * u), std::sin(3 * u), 0);
  return {h * std::tan(kPi / 6) * out + Vec3(0, 0, h), c * out - s * Vec3::UnitZ()};
}
std::pair<Vec3, Vec3> on_saddle(Real u, Real v) {
  const Real x = u - 0.5, y = v - 0.5;
  return {Vec3(x, y, x * y), Vec3(-y, -x, 1).normalized()};
}

const std::vector<std::pair<QuadricType, Place>> kShapes = {{QuadricType::plane, on_plane},
                                                            {QuadricType::sphere, on_sphere},
                                                            {QuadricType::cylinder, on_cylinder},
                                                            {QuadricType::cone, on_cone},
                                                            {QuadricType::general, on_saddle}};

}  // namespace

TEST_CASE("each type is exact on samples of itself, and its gradient is the normal") {
  for (const auto& shape : kShapes) {
    const QuadricType type = shape.first;
    CAPTURE(static_cast<int>(type));
    const auto samples = samples_of(shape.second);
    const Quadric q = fit_quadric(samples, type, 0.01);
    CHECK(q.type == type);
    for (const auto& s : samples) {
      REQUIRE(std::abs(q.distance(s.corner[0])) < 1e-11);
      REQUIRE((q.gradient(s.corner[0]).normalized() - s.normal).norm() < 1e-9);
    }
    CHECK(quadric_error(q, samples, 1.0) < 1e-16);
  }
}

TEST_CASE("the ladder takes the simplest type that fits") {
  for (const auto& shape : kShapes) {
    const QuadricType type = shape.first;
    CAPTURE(static_cast<int>(type));
    QuadricOptions options;
    options.normal_weight = 0.01, options.slack = 1e-6;
    CHECK(fit_quadric(samples_of(shape.second), options).type == type);
  }
  // Noise far below the slack does not make a plane anything else.
  auto samples = samples_of(on_plane);
  const Random random(3, 3);
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (Vec3& p : samples[i].corner) p += 1e-6 * random.normal(i) * samples[i].normal;
  CHECK(fit_quadric(samples, QuadricOptions{}).type == QuadricType::plane);
}

TEST_CASE("radius, axis distance and sign of what was fitted") {
  const Eigen::AngleAxisd turn(0.8, Vec3(1, 2, -0.5).normalized());
  const Vec3 origin(3, -2, 1);
  const Quadric sphere = fit_quadric(samples_of(on_sphere), QuadricType::sphere, 0);
  const Vec3 outside = origin + turn * Vec3(0, 0, 2.6);
  CHECK(sphere.distance(outside) == doctest::Approx((2.6 * 2.6 - 2.5 * 2.5) / (2 * 2.6)));
  auto inner = samples_of(on_sphere);
  for (auto& s : inner) s.normal = -s.normal;
  CHECK(fit_quadric(inner, QuadricType::sphere, 0).distance(outside) < 0);
  const Quadric cylinder = fit_quadric(samples_of(on_cylinder), QuadricType::cylinder, 0);
  CHECK(cylinder.distance(origin + turn * Vec3(0.8, 0, 50)) == doctest::Approx((0.64 - 0.49) / 1.6));
}

TEST_CASE("few, flat or degenerate samples give finite results") {
  const Vec3 p(1, 2, 3);
  for (const Real weight : {0.0, 1.0}) {
    const std::vector<QuadricSample> one = {{{p, p, p}, Vec3::UnitX(), weight}};
    const Quadric q = fit_quadric(one, QuadricOptions{});
    CHECK(q.type == QuadricType::plane);
    CHECK(std::isfinite(q.distance(Vec3(5, 5, 5))));
    CHECK(std::abs(q.distance(p)) < 1e-12);
  }
  for (const auto& [type, place] : kShapes) {
    auto flat = samples_of(on_plane);
    const Quadric q = fit_quadric(flat, type, 0.01);
    CHECK(std::isfinite(quadric_error(q, flat, 1.0)));
    std::vector<QuadricSample> same(30, QuadricSample{{p, p, p}, Vec3::UnitZ(), 1});
    CHECK(std::isfinite(quadric_error(fit_quadric(same, type, 0.01), same, 1.0)));
  }
}
