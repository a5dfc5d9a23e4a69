// Signs of determinants of points, exact: in plain arithmetic where that is certain, else in expansions.
// Source: Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric predicates".
#pragma once

#include "engine/base/types.h"

namespace intarsia {

// Which side of the plane through a, b, c is d on? 1: below, that is a, b, c run clockwise seen from d; -1: above; 0:
// on it. Requires: coordinates between 1e-60 and 1e60 in size, or 0.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// 1 if a, b, c turn left in the plane of the coordinates u and v, -1 if right, 0 if they lie on a line.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, int u, int v);

}  // namespace intarsia
