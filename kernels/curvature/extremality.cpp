#include "kernels/curvature/extremality.h"

#include <cmath>

namespace intarsia::kernels {

Real extremality(const CubicFit& fit, const std::array<Real, 2>& t) {
  const auto [t1, t2] = t;
  const auto [g1, g2] = fit.gradient;
  const auto& [b0, b1, b2] = fit.b;
  const auto& c = fit.c;
  const Real cubic = t1 * t1 * (c[0] * t1 + 3 * c[1] * t2) + t2 * t2 * (3 * c[2] * t1 + c[3] * t2);
  const Real h1 = b0 * t1 + b1 * t2, h2 = b1 * t1 + b2 * t2;
  const Real squared = 1 + g1 * g1 + g2 * g2, w = std::sqrt(squared);
  return -(cubic / w - 3 * (t1 * h1 + t2 * h2) * (g1 * h1 + g2 * h2) / (squared * w));
}

}  // namespace intarsia::kernels
