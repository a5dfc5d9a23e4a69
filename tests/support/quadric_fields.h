// Exact curvature and extremality on surfaces F = x^2/a^2 + y^2/b^2 + z^2/c^2 - 1 = 0 (an infinite axis gives a
// cylinder), in the units of a normalised test surface.
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "engine/data/fields.h"
#include "tests/support/surface.h"

namespace intarsia::test {

inline constexpr Real kInfinite = std::numeric_limits<Real>::infinity();

struct QuadricPoint {
  Vec3 normal, tmax, tmin;
  Real kmax, kmin, emax, emin;
};

// k(t) = H(t, t) / |grad F| along a principal direction t; its derivative along t is -3 k H(t, n) / |grad F|, because
// the third derivatives of F vanish.
inline QuadricPoint quadric_at(const Vec3& p, const Vec3& axes) {
  const Vec3 h = 2 * axes.cwiseInverse().cwiseAbs2(), gradient = h.cwiseProduct(p);
  const Real g = gradient.norm();
  QuadricPoint q;
  q.normal = gradient / g;
  const Vec3 u = q.normal.unitOrthogonal(), v = q.normal.cross(u);
  Eigen::Matrix2d s;
  s << h.cwiseProduct(u).dot(u), h.cwiseProduct(u).dot(v), h.cwiseProduct(u).dot(v), h.cwiseProduct(v).dot(v);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(s / g);
  q.kmin = solver.eigenvalues()[0], q.kmax = solver.eigenvalues()[1];
  const auto direction = [&](int i) { return Vec3(solver.eigenvectors()(0, i) * u + solver.eigenvectors()(1, i) * v); };
  q.tmin = direction(0), q.tmax = direction(1);
  const auto slope = [&](const Vec3& t, Real k) { return -3 * k * h.cwiseProduct(t).dot(q.normal) / g; };
  q.emax = slope(q.tmax, q.kmax), q.emin = slope(q.tmin, q.kmin);
  return q;
}

// Directions point to a random side (seed), as those of a fit do.
inline CurvatureFields quadric_fields(const TestSurface& s, const Vec3& axes, std::uint64_t seed = 1) {
  const Real unit = (s.box.to_input(Vec3(1, 0, 0)) - s.box.to_input(Vec3::Zero())).norm();
  const Random random(seed, 5);
  CurvatureFields f;
  f.resize(s.mesh.vertex_count());
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
    const QuadricPoint q = quadric_at(s.input_point(v), axes);
    const Real side_max = random.uniform(v, 0) < 0.5 ? -1 : 1, side_min = random.uniform(v, 1) < 0.5 ? -1 : 1;
    f.normal.set(v, q.normal), f.tmax.set(v, side_max * q.tmax), f.tmin.set(v, side_min * q.tmin);
    f.kmax[v] = q.kmax * unit, f.kmin[v] = q.kmin * unit;
    f.emax[v] = side_max * q.emax * unit * unit, f.emin[v] = side_min * q.emin * unit * unit;
    f.radius[v] = 1.5 * s.mean_edge;
    f.ring[v] = 2;
    f.status[v] = FitStatus::full;
    f.direction_ok[v] = q.kmax - q.kmin > 0.05 * std::max(std::abs(q.kmax), std::abs(q.kmin));
  }
  return f;
}

// The fields of the same surface with the other side out.
inline CurvatureFields reversed(const CurvatureFields& f) {
  CurvatureFields r = f;
  for (Index v = 0; v < f.vertex_count(); ++v) {
    r.normal.set(v, -f.normal[v]);
    r.kmax[v] = -f.kmin[v], r.kmin[v] = -f.kmax[v];
    r.emax[v] = -f.emin[v], r.emin[v] = -f.emax[v];
  }
  std::swap(r.tmax, r.tmin);
  return r;
}

inline Real total_length(const MeshView& mesh, const CurveNetwork& net) {
  Real length = 0;
  for (Index c = 0; c < net.curve_count(); ++c) {
    const auto row = net.curve.row(c);
    for (std::size_t i = 1; i < row.size(); ++i)
      length += (position(mesh, net.point[row[i]]) - position(mesh, net.point[row[i - 1]])).norm();
  }
  return length;
}

}  // namespace intarsia::test
