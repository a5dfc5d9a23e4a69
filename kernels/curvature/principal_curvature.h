// Principal curvatures and directions of a height function over a plane, convex-positive: the plane's normal points
// outward and a convex surface has h <= 0.
#pragma once

#include <array>

#include "engine/base/types.h"
#include "kernels/curvature/cubic_system.h"

namespace intarsia::kernels {

struct PrincipalCurvature {
  Real kmax = 0, kmin = 0;                     // kmax >= kmin
  std::array<Real, 2> tmax{1, 0}, tmin{0, 1};  // in the plane's coordinates; unit on the surface: t^T (I + g g^T) t = 1
};

// At the origin of the fit; its gradient may be anything finite.
PrincipalCurvature principal_curvature(const CubicFit& fit);

// Whether directions mean anything: the curvatures differ by more than `anisotropy` times the
// larger, and the surface turns by more than `flat_turn` radians over the fit radius.
bool directions_defined(const PrincipalCurvature& k, Real radius, Real anisotropy, Real flat_turn);

}  // namespace intarsia::kernels
