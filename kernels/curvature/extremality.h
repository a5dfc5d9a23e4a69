// Extremality: the derivative of a principal curvature along its own direction (Cao, Yan, Wonka 2014, Eq. 2-3, with the
// factors 3 that its cubic needs; without them the value depends on the frame).
#pragma once

#include <array>

#include "kernels/curvature/cubic_system.h"

namespace intarsia::kernels {

// -(c0 t1^3 + 3 c1 t1^2 t2 + 3 c2 t1 t2^2 + c3 t2^3) where the gradient is 0; in general
// -(C(t,t,t)/W - 3 (t^T H t)(g^T H t)/W^3). Odd in t.
// Requires: t a principal direction, unit on the surface.
Real extremality(const CubicFit& fit, const std::array<Real, 2>& t);

}  // namespace intarsia::kernels
