#include "kernels/baselines/slippage.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace intarsia::kernels {

void SlippageSums::add(Real w, const Vec3& p, const Vec3& n) {
  Vector6 c;
  c << p.cross(n), n;
  weight += w, square += w * p.squaredNorm(), place += w * p;
  form += w * c * c.transpose();
}

SlippageSums& SlippageSums::operator+=(const SlippageSums& o) {
  weight += o.weight, square += o.square, place += o.place, form += o.form;
  return *this;
}

int Slippage::dimension(Real limit) const {
  int d = 0;
  while (d < 6 && value[d] < limit * value[5]) ++d;
  return d;
}

Real Slippage::error_at(const Vec3& p, const Vec3& n, int motions) const {
  Vector6 c;
  c << ((p - centre) / radius).cross(n), n;
  return (motion.leftCols(motions).transpose() * c).squaredNorm();
}

Slippage slippage_of(const SlippageSums& sums) {
  Slippage s;
  if (!(sums.weight > 0)) return s;
  s.centre = sums.place / sums.weight;
  const Real square = sums.square / sums.weight - s.centre.squaredNorm();
  s.radius = square > 0 ? std::sqrt(square) : 1;
  // c of p about the centre, scaled, is a linear function of c about the origin.
  Eigen::Matrix3d cross;
  cross << 0, -s.centre.z(), s.centre.y(), s.centre.z(), 0, -s.centre.x(), -s.centre.y(), s.centre.x(), 0;
  Matrix6 move = Matrix6::Identity();
  move.topLeftCorner<3, 3>() /= s.radius;
  move.topRightCorner<3, 3>() = -cross / s.radius;
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(move * (sums.form / sums.weight) * move.transpose());
  s.value = solver.eigenvalues().cwiseMax(0);
  s.motion = solver.eigenvectors();
  return s;
}

}  // namespace intarsia::kernels
