#include "kernels/quality/transfinite_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace intarsia::kernels {

SideCurve::SideCurve(std::vector<Vec3> point) : point_(std::move(point)), parameter_(point_.size(), 0) {
  for (std::size_t i = 1; i < point_.size(); ++i)
    parameter_[i] = parameter_[i - 1] + (point_[i] - point_[i - 1]).norm();
  length_ = parameter_.back();
  for (std::size_t i = 1; i < point_.size(); ++i)
    parameter_[i] = length_ > 0 ? parameter_[i] / length_ : static_cast<Real>(i) / static_cast<Real>(segments());
  parameter_.back() = 1;
}

Vec3 SideCurve::at(Real s) const {
  if (s <= 0) return point_.front();
  if (s >= 1) return point_.back();
  const auto above = std::upper_bound(parameter_.begin(), parameter_.end(), s);
  const std::size_t i = static_cast<std::size_t>(above - parameter_.begin());
  const Real step = parameter_[i] - parameter_[i - 1], t = (s - parameter_[i - 1]) / step;
  return (1 - t) * point_[i - 1] + t * point_[i];
}

Vec3 SideCurve::slope_at_start() const {
  const Real reach = std::max(Real(0.1), parameter_[1]);
  return (at(reach) - point_.front()) / reach;
}
Vec3 SideCurve::slope_at_end() const {
  const Real reach = std::max(Real(0.1), 1 - parameter_[parameter_.size() - 2]);
  return (point_.back() - at(1 - reach)) / reach;
}

TransfinitePatch::TransfinitePatch(std::vector<SideCurve> side) : side_(std::move(side)) {
  const Index n = sides();
  for (Index j = 0; j < n; ++j) {
    const Real angle = 2 * std::numbers::pi * j / n;
    corner_.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  if (n < 5) return;
  for (Index i = 0; i < n; ++i) {
    const SideCurve &next = side_[wrap(i, 2)], &last = side_[wrap(i, -2)];
    const Vec3 from = next.points().front(), to = last.points().back();
    opposite_.push_back({from, from + next.slope_at_start() / 3, to - last.slope_at_end() / 3, to});
  }
}

Vec3 TransfinitePatch::corner(Index j) const { return corner_[j]; }

Vec3 TransfinitePatch::on_side(Index i, Real s) const { return (1 - s) * corner_[wrap(i, -1)] + s * corner_[i]; }

void TransfinitePatch::coordinates(Real u, Real v, std::span<Real> lambda) const {
  const Index n = sides();
  // Area of (point, corner j, corner j + 1); a corner's weight is the product of all but its own two, which needs no
  // division and is exact on the border.
  Real area[64];
  std::vector<Real> many;
  Real* a = area;
  if (n > 64) many.resize(n), a = many.data();
  for (Index j = 0; j < n; ++j) {
    const Vec3 &p = corner_[j], &q = corner_[wrap(j, 1)];
    a[j] = std::max(Real(0), (p.x() - u) * (q.y() - v) - (p.y() - v) * (q.x() - u));
  }
  Real sum = 0;
  for (Index i = 0; i < n; ++i) {
    Real weight = 1;
    for (Index j = 0; j < n; ++j)
      if (j != i && j != wrap(i, -1)) weight *= a[j];
    lambda[i] = weight, sum += weight;
  }
  if (sum > 0) {
    for (Index i = 0; i < n; ++i) lambda[i] /= sum;
    return;
  }
  // On a corner, up to rounding.
  Index nearest = 0;
  for (Index i = 1; i < n; ++i)
    if ((corner_[i] - Vec3(u, v, 0)).squaredNorm() < (corner_[nearest] - Vec3(u, v, 0)).squaredNorm()) nearest = i;
  for (Index i = 0; i < n; ++i) lambda[i] = i == nearest ? 1 : 0;
}

Vec3 TransfinitePatch::ribbon(Index i, Real s, Real d) const {
  const SideCurve &here = side_[i], &last = side_[wrap(i, -1)], &next = side_[wrap(i, 1)];
  Vec3 opposite;
  if (sides() == 3) {
    opposite = last.points().front();
  } else if (sides() == 4) {
    opposite = side_[wrap(i, 2)].at(1 - s);
  } else {
    const auto& b = opposite_[i];
    const Real t = 1 - s;
    opposite = s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3];
  }
  return (1 - d) * here.at(s) + d * opposite + (1 - s) * last.at(1 - d) + s * next.at(d) -
         ((1 - s) * (1 - d) * here.points().front() + s * (1 - d) * here.points().back() +
          (1 - s) * d * last.points().front() + s * d * next.points().back());
}

Vec3 TransfinitePatch::at(Real u, Real v) const {
  const Index n = sides();
  Real few[64];
  std::vector<Real> many;
  std::span<Real> lambda(few, std::min(n, Index{64}));
  if (n > 64) many.resize(n), lambda = many;
  coordinates(u, v, lambda);
  Vec3 sum = Vec3::Zero();
  for (Index i = 0; i < n; ++i) {
    const Real both = lambda[i] + lambda[wrap(i, -1)];
    if (both <= 0) continue;
    sum += both / 2 * ribbon(i, lambda[i] / both, 1 - both);
  }
  return sum;
}

}  // namespace intarsia::kernels
