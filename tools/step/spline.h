// Cubic B-splines with uniform knots, as curves and as tensor product surfaces.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "engine/base/types.h"

namespace intarsia::tools {

using Vec2 = Eigen::Vector2d;

// The four basis functions that are not zero at a parameter, and their derivatives by it, in units of spans.
struct CubicWeights {
  int first = 0;  // control point of the first one
  std::array<Real, 4> value, slope;
};

// spans >= 1; there are spans + 3 control points. Outside [0, spans] the outermost polynomials go on.
inline CubicWeights cubic_weights(Real at, int spans) {
  const Real cell = std::floor(at);
  CubicWeights w;
  w.first = cell < 0 ? 0 : cell > spans - 1 ? spans - 1 : static_cast<int>(cell);
  const Real t = at - w.first, s = 1 - t;
  w.value = {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6, t * t * t / 6};
  w.slope = {-s * s / 2, (3 * t * t - 4 * t) / 2, (4 * s - 3 * s * s) / 2, t * t / 2};
  return w;
}

// Control points of the same curve with end knots of multiplicity four: it begins in the first one and ends in the
// last. at(i): control point i of spans + 3.
template <class Point, class At>
std::vector<Point> clamped_control(int spans, const At& at) {
  const int n = spans;
  std::vector<Point> out(static_cast<std::size_t>(n) + 3);
  for (int i = 2; i <= n; ++i) out[i] = at(i);
  out[0] = (at(0) + 4 * at(1) + at(2)) / 6;
  out[1] = (2 * at(1) + at(2)) / 3;
  out[n + 1] = (at(n) + 2 * at(n + 1)) / 3;
  out[n + 2] = (at(n) + 4 * at(n + 1) + at(n + 2)) / 6;
  return out;
}

// Over [0, length].
template <class Point>
struct SplineCurve {
  Real length = 0;
  std::vector<Point> control;

  int spans() const { return static_cast<int>(control.size()) - 3; }
  Point at(Real t) const {
    const CubicWeights w = cubic_weights(t / length * spans(), spans());
    return w.value[0] * control[w.first] + w.value[1] * control[w.first + 1] + w.value[2] * control[w.first + 2] +
           w.value[3] * control[w.first + 3];
  }
  std::vector<Point> clamped() const {
    return clamped_control<Point>(spans(), [&](int i) { return control[i]; });
  }
};

// A rectangle of parameters, cut into equal cells.
struct SplineDomain {
  Vec2 low = Vec2::Zero(), high = Vec2::Ones();
  int u_spans = 1, v_spans = 1;

  Real u_step() const { return (high.x() - low.x()) / u_spans; }
  Real v_step() const { return (high.y() - low.y()) / v_spans; }
  int u_count() const { return u_spans + 3; }
  int v_count() const { return v_spans + 3; }
  std::size_t count() const { return static_cast<std::size_t>(u_count()) * v_count(); }
  CubicWeights u_weights(Real u) const { return cubic_weights((u - low.x()) / u_step(), u_spans); }
  CubicWeights v_weights(Real v) const { return cubic_weights((v - low.y()) / v_step(), v_spans); }
};

struct SurfacePointAndSlopes {
  Vec3 point, u, v;
};

struct SplineSurface {
  SplineDomain domain;
  std::vector<Vec3> control;  // v runs fastest

  SurfacePointAndSlopes at(const Vec2& uv) const {
    const CubicWeights a = domain.u_weights(uv.x()), b = domain.v_weights(uv.y());
    SurfacePointAndSlopes s{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    for (int i = 0; i < 4; ++i) {
      const Vec3* row = control.data() + static_cast<std::size_t>(a.first + i) * domain.v_count() + b.first;
      const Vec3 value = b.value[0] * row[0] + b.value[1] * row[1] + b.value[2] * row[2] + b.value[3] * row[3];
      const Vec3 slope = b.slope[0] * row[0] + b.slope[1] * row[1] + b.slope[2] * row[2] + b.slope[3] * row[3];
      s.point += a.value[i] * value, s.u += a.slope[i] * value, s.v += a.value[i] * slope;
    }
    s.u /= domain.u_step(), s.v /= domain.v_step();
    return s;
  }

  // With end knots of multiplicity four in both directions; v runs fastest.
  std::vector<Vec3> clamped() const {
    const int nu = domain.u_count(), nv = domain.v_count();
    std::vector<Vec3> along(control.size()), out(control.size());
    for (int i = 0; i < nu; ++i) {
      const auto row = clamped_control<Vec3>(domain.v_spans, [&](int j) { return control[i * nv + j]; });
      std::copy(row.begin(), row.end(), along.begin() + i * nv);
    }
    for (int j = 0; j < nv; ++j) {
      const auto column = clamped_control<Vec3>(domain.u_spans, [&](int i) { return along[i * nv + j]; });
      for (int i = 0; i < nu; ++i) out[i * nv + j] = column[i];
    }
    return out;
  }
};

// What carries a face: a plane, or a spline surface.
struct FaceSurface {
  bool is_plane = false;
  Vec3 origin = Vec3::Zero(), x = Vec3::UnitX(), y = Vec3::UnitY();  // of the plane; u and v are lengths along x and y
  SplineSurface spline;

  SurfacePointAndSlopes at(const Vec2& uv) const {
    return is_plane ? SurfacePointAndSlopes{origin + uv.x() * x + uv.y() * y, x, y} : spline.at(uv);
  }
  // Gauss-Newton towards the nearest point, from `start`. Stays inside the domain.
  Vec2 nearest(const Vec3& p, const Vec2& start, int steps = 6) const;
};

}  // namespace intarsia::tools
