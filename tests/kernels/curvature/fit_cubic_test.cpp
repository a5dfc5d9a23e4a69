#include "kernels/curvature/fit_cubic.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "kernels/curvature/extremality.h"
#include "kernels/curvature/principal_curvature.h"
#include "tests/support/raw_mesh.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

constexpr Real kLeastPivot = FitOptions{}.least_pivot;

// A cubic height function with all terms.
struct Cubic {
  std::array<Real, 3> b{0.7, -0.3, 1.1};
  std::array<Real, 4> c{1.3, -0.8, 0.4, 2.1};
  Real g1 = 0, g2 = 0;
  Real h(Real x, Real y) const {
    return (b[0] * x * x + 2 * b[1] * x * y + b[2] * y * y) / 2 +
           (c[0] * x * x * x + 3 * c[1] * x * x * y + 3 * c[2] * x * y * y + c[3] * y * y * y) / 6 + g1 * x + g2 * y;
  }
  Real hx(Real x, Real y) const {
    return b[0] * x + b[1] * y + (c[0] * x * x + 2 * c[1] * x * y + c[2] * y * y) / 2 + g1;
  }
  Real hy(Real x, Real y) const {
    return b[1] * x + b[2] * y + (c[1] * x * x + 2 * c[2] * x * y + c[3] * y * y) / 2 + g2;
  }
};

CubicSums sums_of(const Cubic& f, int points, Real radius) {
  CubicSums s;
  for (int i = 0; i < points; ++i) {
    const Real a = 2 * std::numbers::pi * i / points + 0.3, r = radius * (1 + 0.35 * (i % 3));
    const Real x = r * std::cos(a), y = r * std::sin(a), z = f.h(x, y);
    s.add(x, y, z, f.hx(x, y), f.hy(x, y), 1, std::sqrt(x * x + y * y + z * z));
  }
  return s;
}

// c0 rho^2 / delta for a plane whose normal at the centre alone is tilted by delta towards x, over hexagonal rings.
Real tilt_response(int rings, Real delta) {
  CubicSums s;
  const Real cosine = std::cos(delta), sine = std::sin(delta);
  for (int i = -rings; i <= rings; ++i)
    for (int j = -rings; j <= rings; ++j) {
      if (std::abs(i + j) > rings || (i == 0 && j == 0)) continue;
      const Real px = i + 0.5 * j, py = j * std::numbers::sqrt3 / 2;
      // In the tilted frame u = (cos, 0, -sin), n = (sin, 0, cos).
      const Real x = cosine * px, z = sine * px;
      s.add(x, py, z, sine / cosine, 0, 1, std::hypot(px, py));
    }
  CubicFit fit;
  REQUIRE(solve_cubic(s, 7, kLeastPivot, fit));
  for (Real b : fit.b) CHECK(std::abs(b) < 1e-12);
  return std::abs(fit.c[0]) * s.unit() * s.unit() / delta;
}

Vec3 ellipsoid_normal(const Vec3& p) { return Vec3(p.x() / 9, p.y() / 4, p.z()).normalized(); }

}  // namespace

TEST_CASE("a cubic is found exactly, at any scale") {
  const Cubic f;
  for (int points : {3, 6, 12})
    for (Real scale : {1e-3, 1.0, 1e3}) {
      CAPTURE(points);
      Cubic g = f;  // the same shape, larger: h(x) = scale f(x / scale)
      for (Real& b : g.b) b /= scale;
      for (Real& c : g.c) c /= scale * scale;
      CubicFit fit;
      REQUIRE(solve_cubic(sums_of(g, points, 0.4 * scale), 7, kLeastPivot, fit));
      for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(fit.b[i] * scale - f.b[i]) < 1e-11);
      for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(fit.c[i] * scale * scale - f.c[i]) < 1e-11);
    }
}

TEST_CASE("nine and ten terms find a tilted and lifted cubic exactly") {
  Cubic f;
  f.g1 = 0.2, f.g2 = -0.1;
  CubicFit fit;
  REQUIRE(solve_cubic(sums_of(f, 12, 0.5), 9, kLeastPivot, fit));
  CHECK(std::abs(fit.gradient[0] - 0.2) < 1e-12);
  CHECK(std::abs(fit.gradient[1] + 0.1) < 1e-12);
  CHECK(std::abs(fit.c[3] - f.c[3]) < 1e-11);
  CubicSums lifted;
  for (int i = 0; i < 20; ++i) {
    const Real x = 0.1 * (i % 5) - 0.2, y = 0.13 * (i / 5) - 0.2;
    lifted.add(x, y, f.h(x, y) + 0.05, f.hx(x, y), f.hy(x, y), 1 + 0.1 * i, std::hypot(x, y));
  }
  REQUIRE(solve_cubic(lifted, 10, kLeastPivot, fit));
  CHECK(std::abs(fit.offset - 0.05) < 1e-12);
  CHECK(std::abs(fit.b[1] - f.b[1]) < 1e-11);
}

TEST_CASE("points on a line do not determine a cubic") {
  CubicSums s;
  for (int i = -5; i <= 5; ++i)
    if (i != 0) s.add(0.1 * i, 0.05 * i, 0.01 * i * i, 0.02 * i, 0.01 * i, 1, 0.1118 * std::abs(i));
  CubicFit fit;
  CHECK_FALSE(solve_cubic(s, 7, kLeastPivot, fit));
  CHECK_FALSE(solve_cubic(CubicSums{}, 7, kLeastPivot, fit));
}

TEST_CASE("a wrong normal at the centre answers as 2.73, 2.13, 2.00 delta / rho^2") {
  CHECK(tilt_response(1, 1e-4) == doctest::Approx(2.73).epsilon(0.005));
  CHECK(tilt_response(2, 1e-4) == doctest::Approx(2.134).epsilon(0.001));
  CHECK(tilt_response(3, 1e-4) == doctest::Approx(2.00).epsilon(0.005));
}

TEST_CASE("curvature and extremality of an ellipsoid converge with order 2") {
  const Vec3 direction(1.541, 0.849, 0.745);
  const Vec3 p = direction / std::sqrt(direction.x() * direction.x() / 9 + direction.y() * direction.y() / 4 +
                                       direction.z() * direction.z());
  const Frame frame(ellipsoid_normal(p));
  std::array<Real, 4> e, k;
  std::size_t level = 0;
  for (Real h : {0.2, 0.1, 0.05, 0.025}) {
    CubicSums s;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j) {
        if (std::abs(i + j) > 2 || (i == 0 && j == 0)) continue;
        Vec3 q = p + h * (i + 0.5 * j) * frame.u + h * (j * std::numbers::sqrt3 / 2) * frame.v;
        for (int step = 0; step < 40; ++step) {  // along the normal of p onto the ellipsoid
          const Real value = q.x() * q.x() / 9 + q.y() * q.y() / 4 + q.z() * q.z() - 1;
          const Vec3 gradient(2 * q.x() / 9, 2 * q.y() / 4, 2 * q.z());
          q -= value / gradient.dot(frame.n) * frame.n;
        }
        const Vec3 d = q - p, n = ellipsoid_normal(q);
        const Real up = frame.n.dot(n);
        s.add(frame.u.dot(d), frame.v.dot(d), frame.n.dot(d), -frame.u.dot(n) / up, -frame.v.dot(n) / up, 1, d.norm());
      }
    CubicFit fit;
    REQUIRE(solve_cubic(s, 7, kLeastPivot, fit));
    const PrincipalCurvature c = principal_curvature(fit);
    e[level] = std::abs(extremality(fit, c.tmax));
    k[level++] = c.kmax;
  }
  CHECK(e[3] == doctest::Approx(0.3477).epsilon(0.005));
  for (std::size_t i = 0; i + 2 < 4; ++i) {
    CHECK((e[i] - e[i + 1]) / (e[i + 1] - e[i + 2]) == doctest::Approx(4).epsilon(0.3));
    CHECK((k[i] - k[i + 1]) / (k[i + 1] - k[i + 2]) == doctest::Approx(4).epsilon(0.3));
  }
}

TEST_CASE("principal curvatures, directions and extremality in closed form") {
  CubicFit saddle;  // z = xy
  saddle.b = {0, 1, 0};
  const PrincipalCurvature k = principal_curvature(saddle);
  CHECK(k.kmax == doctest::Approx(1));
  CHECK(k.kmin == doctest::Approx(-1));
  CHECK(std::abs(extremality(saddle, k.tmax)) < 1e-15);

  CubicFit crest;  // z = -x^2 + 1.5 x^3 / 6: k = 2, along +x it falls by 1.5
  crest.b = {-2, 0, 0};
  crest.c = {1.5, 0, 0, 0};
  const PrincipalCurvature c = principal_curvature(crest);
  CHECK(c.kmax == doctest::Approx(2));
  CHECK(std::abs(c.tmax[0]) == doctest::Approx(1));
  CHECK(extremality(crest, c.tmax) * c.tmax[0] == doctest::Approx(-1.5));
  CHECK(extremality(crest, {-c.tmax[0], -c.tmax[1]}) == -extremality(crest, c.tmax));
}

TEST_CASE("extremality does not depend on the frame about the normal") {
  const Cubic f;
  CubicFit fit;
  fit.b = f.b, fit.c = f.c;
  const PrincipalCurvature k = principal_curvature(fit);
  for (Real a : {0.35, 0.8, 1.2}) {
    // h in coordinates turned by a, by sampling the same cubic: an exact fit gives the turned coefficients.
    CubicSums s;
    for (int i = 0; i < 12; ++i) {
      const Real angle = 0.5236 * i, r = 0.3 + 0.1 * (i % 3), x = r * std::cos(angle), y = r * std::sin(angle);
      const Real ox = std::cos(a) * x - std::sin(a) * y, oy = std::sin(a) * x + std::cos(a) * y;
      const Real hx = f.hx(ox, oy), hy = f.hy(ox, oy);
      s.add(x, y, f.h(ox, oy), std::cos(a) * hx + std::sin(a) * hy, -std::sin(a) * hx + std::cos(a) * hy, 1, r);
    }
    CubicFit turned;
    REQUIRE(solve_cubic(s, 7, kLeastPivot, turned));
    const PrincipalCurvature t = principal_curvature(turned);
    CHECK(t.kmax == doctest::Approx(k.kmax));
    CHECK(std::abs(extremality(turned, t.tmax)) == doctest::Approx(std::abs(extremality(fit, k.tmax))));
    CHECK(std::abs(extremality(turned, t.tmin)) == doctest::Approx(std::abs(extremality(fit, k.tmin))));
  }
}

TEST_CASE("the general formula agrees with the adapted frame") {
  // Profile curves z = f(x): k' = (f''' (1 + f'^2) - 3 f' f''^2) / (1 + f'^2)^3 per unit length, convex-positive.
  CubicFit fit;
  fit.gradient = {0.4, 0};
  fit.b = {-1.3, 0, 0};
  fit.c = {0.9, 0, 0, 0};
  const PrincipalCurvature k = principal_curvature(fit);
  const Real w2 = 1 + 0.16;
  CHECK(k.kmax == doctest::Approx(1.3 / std::pow(w2, 1.5)));
  const Real derivative = -(0.9 * w2 - 3 * 0.4 * 1.3 * 1.3) / (w2 * w2 * w2);
  CHECK(extremality(fit, k.tmax) * (k.tmax[0] > 0 ? 1 : -1) == doctest::Approx(derivative));
  const auto unit = [&](const std::array<Real, 2>& t) {
    const Real along = fit.gradient[0] * t[0] + fit.gradient[1] * t[1];
    return t[0] * t[0] + t[1] * t[1] + along * along;
  };
  fit.gradient = {0.4, -0.7}, fit.b = {1, 0.3, -0.4};
  const PrincipalCurvature g = principal_curvature(fit);
  CHECK(unit(g.tmax) == doctest::Approx(1));
  CHECK(unit(g.tmin) == doctest::Approx(1));
  // Gauss curvature det(H) / W^4.
  const Real w = std::sqrt(1 + 0.16 + 0.49);
  CHECK(g.kmax * g.kmin == doctest::Approx((1 * -0.4 - 0.09) / (w * w * w * w)));
}

TEST_CASE("frames are right-handed for every normal") {
  for (const Vec3& n :
       {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0.6, -0.8, 0), Vec3(1, 2, -3).normalized()}) {
    const Frame f(n);
    CHECK((f.u.cross(f.v) - n).norm() < 1e-15);
    CHECK(std::abs(f.u.dot(n)) < 1e-15);
    CHECK(f.u.norm() == doctest::Approx(1));
  }
}

TEST_CASE("statuses: full on fans, grown or quadratic where points are few, invalid alone") {
  const auto fit_at = [](const Soup& soup, Index v, int ring) {
    const Mesh m = raw_mesh(soup);
    Vec3Array normal(m.vertex_count());
    for (Index i = 0; i < m.vertex_count(); ++i) normal.set(i, Vec3::UnitZ());
    RingWalker walker(m);
    PointBatch batch;
    return fit_rings(m, normal, v, Frame(Vec3::UnitZ()), ring, 7, FitOptions{}, walker, batch);
  };
  const auto fan = [](int spokes, Real turn) {
    Soup s;
    add_vertex(s, Vec3::Zero());
    for (int i = 0; i <= spokes; ++i) add_vertex(s, Vec3(std::cos(i * turn / spokes), std::sin(i * turn / spokes), 0));
    for (int i = 0; i < spokes; ++i) add_face(s, 0, static_cast<Index>(1 + i), static_cast<Index>(2 + i));
    return s;
  };
  CHECK(fit_at(fan(2, 2.0944), 0, 1).status == FitStatus::full);  // three neighbours over 120 degrees
  CHECK(fit_at(fan(3, 3.1416), 0, 1).status == FitStatus::full);  // half a ring: a boundary
  const Soup sheet = plane(8, 8);
  CHECK(fit_at(sheet, 0, 1).ring <= 3);
  CHECK(fit_at(sheet, 40, 2).status == FitStatus::full);
  CHECK(fit_at(sheet, 40, 2).ring == 2);
  Soup lonely = plane(2, 2);
  const Index v = add_vertex(lonely, Vec3(3, 3, 3));
  CHECK(fit_at(lonely, v, 2).status == FitStatus::invalid);
  Soup triangle;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) add_vertex(triangle, p);
  add_face(triangle, 0, 1, 2);
  CHECK(fit_at(triangle, 0, 2).status == FitStatus::invalid);  // two points
  // A corner with two neighbours: ring 1 is too small, ring 2 is not.
  const VertexFit corner = fit_at(plane(6, 6), 6, 1);
  CHECK(corner.status == FitStatus::ring_grown);
  CHECK(corner.ring == 2);
}
