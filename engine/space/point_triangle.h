// Exact closest point of a triangle to a point.
#pragma once

#include "engine/base/types.h"

namespace intarsia {

// Closest point of triangle abc to p, by the Voronoi region of the triangle that p lies in (Ericson 2005, 5.1.5).
// Degenerate triangles are segments or points; never NaN for finite input.
inline Vec3 closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const Real length2 = ab.squaredNorm();
  const Real t = length2 > 0 ? (p - a).dot(ab) / length2 : 0;
  return t <= 0 ? a : t >= 1 ? b : Vec3(a + t * ab);
}

inline Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const Real d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bp = p - b;
  const Real d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const Vec3 cp = p - c;
  const Real d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const Real vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  const Real sum = va + vb + vc;
  if (!(va > 0 && vb > 0 && vc > 0 && sum > 0)) {  // outside, or without area: the nearest of the three sides
    const Vec3 on_ab = closest_on_segment(p, a, b), on_bc = closest_on_segment(p, b, c),
               on_ca = closest_on_segment(p, c, a);
    const Real x = (p - on_ab).squaredNorm(), y = (p - on_bc).squaredNorm(), z = (p - on_ca).squaredNorm();
    return x <= y && x <= z ? on_ab : y <= z ? on_bc : on_ca;
  }
  return a + (vb / sum) * ab + (vc / sum) * ac;
}

}  // namespace intarsia
