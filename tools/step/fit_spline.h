// Least squares fits of curves and surfaces to points with known parameters.
#pragma once

#include <span>
#include <vector>

#include "tools/step/spline.h"

namespace intarsia::tools {

// Through the first and the last point exactly (up to rounding).
// t ascending from 0 to length; as many points as parameters, at least two; spans >= 1.
SplineCurve<Vec2> fit_curve(std::span<const Real> t, std::span<const Vec2> point, int spans);
SplineCurve<Vec3> fit_curve(std::span<const Real> t, std::span<const Vec3> point, int spans);

struct SurfaceSamples {
  std::vector<Vec2> uv;
  std::vector<Vec3> point;
  std::vector<Real> weight;  // area (in the units of uv) that the sample stands for, times its importance

  void add(const Vec2& at, const Vec3& p, Real w) { uv.push_back(at), point.push_back(p), weight.push_back(w); }
  std::size_t size() const { return uv.size(); }
};

// Minimises the weighted squared distances plus stiffness^4 times the thin plate energy, where `stiffness` is a length
// in cells: features smaller than that are smoothed, and where there are no samples the surface bends as little as it
// can. Planes are reproduced exactly. Requires: some samples that are not on one line; stiffness > 0.
SplineSurface fit_surface(const SplineDomain& domain, const SurfaceSamples& samples, Real stiffness = 0.03);

}  // namespace intarsia::tools
