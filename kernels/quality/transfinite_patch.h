// The C0 transfinite patch of n boundary curves (Salvi 2020, "A multi-sided generalization of the C0 Coons patch").
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/types.h"

namespace intarsia::kernels {

// Polyline with parameters from 0 to 1 by length.
class SideCurve {
 public:
  // Requires: at least two points.
  explicit SideCurve(std::vector<Vec3> point);
  Vec3 at(Real s) const;
  Vec3 slope_at_start() const;  // derivative by the parameter, over the first tenth
  Vec3 slope_at_end() const;
  Real length() const { return length_; }
  Index segments() const { return static_cast<Index>(point_.size() - 1); }
  Real parameter(Index i) const { return parameter_[i]; }
  const std::vector<Vec3>& points() const { return point_; }

 private:
  std::vector<Vec3> point_;
  std::vector<Real> parameter_;
  Real length_ = 0;
};

// Side i runs from corner i - 1 to corner i of a regular polygon with corner j at angle 2 pi j / n on the unit circle.
// Sides form a closed loop. Requires: at least three.
class TransfinitePatch {
 public:
  explicit TransfinitePatch(std::vector<SideCurve> side);

  Index sides() const { return static_cast<Index>(side_.size()); }
  const SideCurve& side(Index i) const { return side_[i]; }
  // Domain point on side i at parameter s.
  Vec3 on_side(Index i, Real s) const;
  Vec3 corner(Index j) const;
  // u, v inside the domain polygon or on it.
  Vec3 at(Real u, Real v) const;
  // Wachspress coordinates; they add up to 1.
  void coordinates(Real u, Real v, std::span<Real> lambda) const;

 private:
  Vec3 ribbon(Index i, Real s, Real d) const;
  Index wrap(Index i, int by) const {
    const int n = static_cast<int>(sides());
    return static_cast<Index>((static_cast<int>(i) + by + 2 * n) % n);
  }
  std::vector<SideCurve> side_;
  std::vector<std::array<Vec3, 4>> opposite_;  // Bezier points, five sides and more
  std::vector<Vec3> corner_;
};

}  // namespace intarsia::kernels
