#include "kernels/curvature/principal_curvature.h"

#include <algorithm>
#include <cmath>

namespace intarsia::kernels {

PrincipalCurvature principal_curvature(const CubicFit& fit) {
  const auto [g1, g2] = fit.gradient;
  // In the metric I + g g^T the map B = I - g g^T / (W (W + 1)) takes orthonormal pairs to orthonormal pairs.
  const Real w = std::sqrt(1 + g1 * g1 + g2 * g2), f = 1 / (w * (w + 1));
  const Real m11 = 1 - f * g1 * g1, m12 = -f * g1 * g2, m22 = 1 - f * g2 * g2;
  const Real h11 = -fit.b[0] / w, h12 = -fit.b[1] / w, h22 = -fit.b[2] / w;
  const Real p11 = h11 * m11 + h12 * m12, p12 = h11 * m12 + h12 * m22;
  const Real p21 = h12 * m11 + h22 * m12, p22 = h12 * m12 + h22 * m22;
  const Real s11 = m11 * p11 + m12 * p21, s12 = m11 * p12 + m12 * p22, s22 = m12 * p12 + m22 * p22;

  const Real mean = (s11 + s22) / 2, half = (s11 - s22) / 2, q = std::sqrt(half * half + s12 * s12);
  const Real phi = std::atan2(s12, half) / 2, c = std::cos(phi), s = std::sin(phi);
  PrincipalCurvature out;
  out.kmax = mean + q;
  out.kmin = mean - q;
  out.tmax = {m11 * c + m12 * s, m12 * c + m22 * s};
  out.tmin = {-m11 * s + m12 * c, -m12 * s + m22 * c};
  return out;
}

bool directions_defined(const PrincipalCurvature& k, Real radius, Real anisotropy, Real flat_turn) {
  const Real most = std::max(std::abs(k.kmax), std::abs(k.kmin));
  return most * radius > flat_turn && k.kmax - k.kmin > anisotropy * most;
}

}  // namespace intarsia::kernels
