// Distances of simple solids and ways to join them, for values and gradients alike. Each is exact outside, or a lower
// bound; `Real` arguments are sizes, T is Real or Dual.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/make/dual.h"

namespace intarsia::tools {

// Both a and b (distances), their common outer edge rounded with radius r. Exact where a and b are orthogonal.
template <class T>
T intersect_round(const T& a, const T& b, Real r) {
  if (value_of(a) <= -r || value_of(b) <= -r) return larger(a, b);
  return smaller(T(-r), larger(a, b)) + corner_length(T(a + r), T(b + r));
}

// Either a or b, with a fillet of radius r in the inner edge. Exact where a and b are orthogonal.
template <class T>
T unite_round(const T& a, const T& b, Real r) {
  if (value_of(a) >= r || value_of(b) >= r) return smaller(a, b);
  return larger(T(r), smaller(a, b)) - corner_length(T(r - a), T(r - b));
}

// Either a or b, blended over the width k with continuous curvature (cubic).
template <class T>
T unite_smooth(const T& a, const T& b, Real k) {
  if (std::abs(value_of(a) - value_of(b)) >= k) return smaller(a, b);
  const T h = (k - magnitude(T(a - b))) / k;
  return smaller(a, b) - h * square(h) * (k / 6);
}
template <class T>
T intersect_smooth(const T& a, const T& b, Real k) {
  return -unite_smooth(T(-a), T(-b), k);
}

// A flat shape with distance a, extruded over |w| <= half, edges rounded with radius r inside the body.
template <class T>
T extrude_round(const T& a, const T& w, Real half, Real r) {
  const T qa = a + r, qb = magnitude(w) - (half - r);
  return smaller(larger(qa, qb), T(0)) + corner_length(qa, qb) - r;
}

// Box with rounded edges, half sizes include the radius r.
template <class T>
T box_round(const T& x, const T& y, const T& z, const std::array<Real, 3>& half, Real r) {
  const T qx = magnitude(x) - (half[0] - r), qy = magnitude(y) - (half[1] - r), qz = magnitude(z) - (half[2] - r);
  return corner_length(qx, corner_length(qy, qz)) + smaller(larger(qx, larger(qy, qz)), T(0)) - r;
}

// Convex hull of two circles in the plane, around (ax, ay) with radius ra and around (bx, by) with radius rb.
template <class T>
T tapered_bar(const T& x, const T& y, Real ax, Real ay, Real ra, Real bx, Real by, Real rb) {
  const Real l = std::hypot(bx - ax, by - ay), ux = (bx - ax) / l, uy = (by - ay) / l;
  const T along = (x - ax) * ux + (y - ay) * uy, across = magnitude(T((y - ay) * ux - (x - ax) * uy));
  const Real s = (ra - rb) / l, c = std::sqrt(1 - s * s);  // the straight sides lean by asin(s)
  const T foot = along * c - across * s;
  if (value_of(foot) < 0) return length(along, across) - ra;
  if (value_of(foot) > l * c) return length(T(along - l), across) - rb;
  return along * s + across * c - ra;
}

// Regular hexagon in the plane around the origin, `r` from the centre to a side.
template <class T>
T hexagon(const T& x, const T& y, Real r) {
  constexpr Real kCos = 0.8660254037844386, kSin = 0.5;
  const T px = magnitude(x), py = magnitude(y);
  const T top = py - r, lean = px * kCos + py * kSin - r;
  const Real half = r * 0.5773502691896258;  // half of a side
  // Distance to the top side and to the leaning side as segments.
  const T along = px * kSin - py * kCos;
  const T d_top = length(positive(T(px - half)), top), d_lean = length(positive(T(magnitude(along) - half)), lean);
  if (value_of(top) <= 0 && value_of(lean) <= 0) return larger(top, lean);
  return smaller(d_top, d_lean);
}

// Round cone: convex hull of two spheres around points of the axis from a to b.
template <class T>
T round_cone(const T& x, const T& y, const T& z, const std::array<Real, 3>& a, Real ra, const std::array<Real, 3>& b,
             Real rb) {
  const Real ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2], l = std::sqrt(ux * ux + uy * uy + uz * uz);
  const T px = x - a[0], py = y - a[1], pz = z - a[2];
  const T along = (px * ux + py * uy + pz * uz) / l;
  const T rest = positive(T(square(px) + square(py) + square(pz) - square(along)));
  return tapered_bar(along, root(rest), 0, 0, ra, l, 0, rb);
}

// Scaled distance of an ellipsoid: at most the true distance.
template <class T>
T ellipsoid_at(const T& x, const T& y, const T& z, const std::array<Real, 3>& centre, const std::array<Real, 3>& axes) {
  const Real least = std::min(axes[0], std::min(axes[1], axes[2]));
  return (length(T((x - centre[0]) / axes[0]), T((y - centre[1]) / axes[1]), T((z - centre[2]) / axes[2])) - 1.0) *
         least;
}

}  // namespace intarsia::tools
