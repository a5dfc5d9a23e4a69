// Choices that grids and surface nets share.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "engine/base/random.h"
#include "engine/base/types.h"

namespace intarsia::tools {

// Sine of the smallest angle of a triangle; 0 without area.
inline Real smallest_sine(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - b, w = a - c;
  const Real uu = u.squaredNorm(), vv = v.squaredNorm(), ww = w.squaredNorm();
  const Real longest = std::max(uu * vv, std::max(vv * ww, ww * uu));  // the two longest sides hold the smallest angle
  return longest > 0 ? u.cross(w).norm() / std::sqrt(longest) : 0;
}

// 0: split along the diagonal from corner 0, 1: from corner 1, whichever has the larger smallest angle; where both are
// as good (an even grid), `tie` decides.
inline int better_diagonal(const std::array<Vec3, 4>& p, bool tie) {
  const Real first = std::min(smallest_sine(p[0], p[1], p[2]), smallest_sine(p[0], p[2], p[3]));
  const Real second = std::min(smallest_sine(p[1], p[2], p[3]), smallest_sine(p[1], p[3], p[0]));
  if (std::abs(first - second) < 1e-9) return tie ? 1 : 0;
  return first < second ? 1 : 0;
}

// Uniform on the unit sphere.
inline Vec3 random_direction(const Random& random, std::uint64_t element) {
  const Real z = 2 * random.uniform(element, 0) - 1, phi = 6.283185307179586 * random.uniform(element, 1);
  const Real r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace intarsia::tools
