#include "kernels/scale/voting_tensor.h"

#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "tests/support/raw_mesh.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

Variation variation_at(const Mesh& m, Index v) {
  RingWalker walker(m);
  VotingScratch scratch;
  return variation_of(m, v, true, walker, scratch);
}

Soup crease(Real degrees) {
  const Real a = degrees * std::numbers::pi / 180;
  return row_grid(40, 40, 0.1,
                  [&](Real x, Real y) { return x <= 0 ? Vec3(x, y, 0) : Vec3(x * std::cos(a), y, -x * std::sin(a)); });
}

void check_row(const RingValues& omega, const std::array<Real, kRings>& table, Real tolerance) {
  for (std::size_t k = 0; k < kRings; ++k) {
    CAPTURE(k);
    CHECK(std::abs(omega[k] - table[k]) <= tolerance);
  }
}

// Eq. 4-6 once more, by brute force over graph distances and Eigen's solver.
RingValues reference(const MeshView& m, Index v) {
  std::vector<int> distance(m.vertex_count(), 99);
  distance[v] = 0;
  for (int k = 1; k < kRings; ++k)
    for (Index u = 0; u < m.vertex_count(); ++u)
      if (distance[u] == k - 1)
        for (Index w : m.vertex_vertices.row(u)) distance[w] = std::min(distance[w], k);
  RingValues out;
  for (int k = 1; k <= kRings; ++k) {
    Real reach = 0, largest = 0;
    std::vector<std::array<Vec3, 2>> faces;
    for (Index f = 0; f < m.face_count(); ++f) {
      const auto [a, b, c] = m.face(f);
      if (std::min({distance[a], distance[b], distance[c]}) > k - 1) continue;
      const Vec3 cross = (m.point(b) - m.point(a)).cross(m.point(c) - m.point(a));
      const Vec3 to = (m.point(a) + m.point(b) + m.point(c)) / 3 - m.point(v);
      faces.push_back({cross, to});
      reach = std::max(reach, to.norm());
      largest = std::max(largest, cross.norm());
    }
    Eigen::Matrix3d t = Eigen::Matrix3d::Zero();
    for (const auto& [cross, to] : faces) {
      const Vec3 n = cross.normalized();
      t += cross.norm() / largest * std::exp(-to.norm() / reach) * n * n.transpose();
    }
    const Vec3 l = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(t).eigenvalues();
    out[k - 1] = (l[0] + l[1]) / l[2];
  }
  return out;
}

}  // namespace

TEST_CASE("decay is exp(-t) on [0, 1]") {
  for (int i = 0; i <= 100; ++i) CHECK(std::abs(decay(i / 100.0) - std::exp(-i / 100.0)) < 1e-15);
}

TEST_CASE("variation of a tensor in closed form") {
  CHECK(variation_of_tensor({1, 0, 0, 0, 0, 0}) == doctest::Approx(0).epsilon(1e-15));
  CHECK(variation_of_tensor({1, 0, 0, 1, 0, 0}) == doctest::Approx(1));
  CHECK(variation_of_tensor({3, 0, 0, 3, 0, 3}) == doctest::Approx(2));
  CHECK(variation_of_tensor({0, 0, 0, 0, 0, 0}) == 0);
  // Two planes, share p, angle theta: l = (1 +- sqrt(1 - 4 p (1 - p) sin^2 theta)) / 2.
  for (Real p : {0.1, 0.3, 0.5})
    for (Real theta : {0.2, 1.0, 1.6, 2.8}) {
      const Real c = std::cos(theta), s = std::sin(theta), root = std::sqrt(1 - 4 * p * (1 - p) * s * s);
      const Real omega = variation_of_tensor({p + (1 - p) * c * c, (1 - p) * c * s, 0, (1 - p) * s * s, 0, 0});
      CHECK(std::abs(omega - (1 - root) / (1 + root)) < 1e-14);
    }
}

TEST_CASE("a plane has no variation, the corner of a cube has 2") {
  const Mesh flat = raw_mesh(transformed(
      plane(16, 16), [](const Vec3& p) { return Vec3(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()) * p); }));
  for (Index v : {Index{0}, Index{140}})
    for (Real w : variation_at(flat, v).omega) CHECK(std::abs(w) < 1e-14);
  const Mesh corner = raw_mesh(cube(16));
  for (Real w : variation_at(corner, nearest_vertex(corner, Vec3::Zero())).omega) CHECK(std::abs(w - 2) < 1e-12);
}

TEST_CASE("symmetric creases, on the line and beside it") {
  const Vec3 middle(0, 0, 0);
  const auto at = [&](Real degrees, int away) {
    const Mesh m = raw_mesh(crease(degrees));
    return variation_at(m, nearest_vertex(m, Vec3(-0.1 * away, 0, 0))).omega;
  };
  check_row(at(45, 0), {.165, .168, .170, .171, .171, .171}, 1e-3);
  check_row(at(60, 0), {.317, .325, .329, .331, .332, .332}, 1e-3);
  check_row(at(90, 0), {.722, .792, .855, .886, .908, .922}, 1e-3);
  check_row(at(90, 1), {0, .289, .462, .571, .644, .697}, 1e-3);
  check_row(at(90, 2), {0, 0, .108, .239, .340, .420}, 1e-3);
  check_row(at(90, 3), {0, 0, 0, .056, .138, .224}, 2e-3);
}

TEST_CASE("spheres and cylinders") {
  const Mesh sphere = raw_mesh(icosphere(4));
  RingWalker walker(sphere);
  VotingScratch scratch;
  RingValues mean{};
  for (Index v = 0; v < sphere.vertex_count(); ++v) {
    const Variation at = variation_of(sphere, v, false, walker, scratch);
    for (std::size_t k = 0; k < kRings; ++k) mean[k] += at.omega[k] / sphere.vertex_count();
  }
  const RingValues table{.00187, .0076, .0175, .0314, .0501, .0732};
  for (std::size_t k = 0; k < kRings; ++k) CHECK(mean[k] == doctest::Approx(table[k]).epsilon(0.05));
  const Real h = 2 * std::numbers::pi / 96;
  const Mesh tube = raw_mesh(row_grid(40, 40, h, [](Real x, Real y) { return Vec3(std::sin(x), y, std::cos(x)); }));
  check_row(variation_at(tube, nearest_vertex(tube, Vec3(0, 0, 1))).omega, {.00104, .0033, .0073, .0129, .0201, .0290},
            3e-4);
}

TEST_CASE("Eq. 6 against brute force on an irregular surface with a boundary") {
  const Mesh m =
      raw_mesh(jittered(height_field(14, 14, -1, 1, -1, 1, [](Real x, Real y) { return x * x - 0.4 * y; }), 0.03, 5));
  for (Index v = 0; v < m.vertex_count(); v += 13) {
    const RingValues omega = variation_at(m, v).omega, expected = reference(m, v);
    for (std::size_t k = 0; k < kRings; ++k) CHECK(std::abs(omega[k] - expected[k]) < 1e-13);
  }
}

TEST_CASE("variation does not change with position, size, rotation or orientation") {
  const Soup s =
      jittered(height_field(14, 14, -1, 1, -1, 1, [](Real x, Real y) { return 0.5 * x * x - y * y; }), 0.02, 6);
  const Mesh m = raw_mesh(s);
  const Mesh moved = raw_mesh(transformed(s, [](const Vec3& p) {
    return Vec3(3 * (Eigen::AngleAxisd(1.1, Vec3(3, 1, 2).normalized()) * p) + Vec3(1, 2, 3));
  }));
  const Mesh turned = raw_mesh(reversed(s));
  for (Index v = 0; v < m.vertex_count(); v += 17) {
    const Variation a = variation_at(m, v), b = variation_at(moved, v), c = variation_at(turned, v);
    for (std::size_t k = 0; k < kRings; ++k) {
      CHECK(std::abs(a.omega[k] - b.omega[k]) < 1e-12);
      CHECK(std::abs(a.omega[k] - c.omega[k]) < 1e-13);
      CHECK(std::abs(a.folded[k] - c.folded[k]) < 1e-12);
    }
  }
}

TEST_CASE("the first moment sees knife edges that the tensor takes for flat") {
  for (Real degrees : {120.0, 150.0, 165.0}) {
    const Mesh m = raw_mesh(crease(degrees));
    const Variation variation = variation_at(m, nearest_vertex(m, Vec3::Zero()));
    const Real t = std::tan(degrees * std::numbers::pi / 360);
    CHECK(variation.omega[5] < 0.4);
    CHECK(variation.folded[5] == doctest::Approx(t * t).epsilon(0.1));
    CHECK(variation.folded[5] > 2);
  }
  const Mesh gentle = raw_mesh(crease(60));
  const Variation same = variation_at(gentle, nearest_vertex(gentle, Vec3::Zero()));
  CHECK(same.folded == same.omega);
}

TEST_CASE("degenerate faces vote for nothing") {
  Soup s = plane(6, 6);
  const Index a = add_vertex(s, Vec3(0.5, 0.5, 0)), b = add_vertex(s, Vec3(0.5, 0.5, 0));
  add_face(s, 24, a, b);
  const Mesh m = raw_mesh(s);
  for (Index v : {Index{24}, a})
    for (Real w : variation_at(m, v).omega) CHECK(std::abs(w) < 1e-14);
}
