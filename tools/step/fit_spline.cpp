#include "tools/step/fit_spline.h"

#include <Eigen/SparseCholesky>

#include "engine/base/error.h"

namespace intarsia::tools {
namespace {

using Sparse = Eigen::SparseMatrix<Real>;
using Triplet = Eigen::Triplet<Real, int>;

template <class Point>
SplineCurve<Point> fit(std::span<const Real> t, std::span<const Point> point, int spans) {
  const int n = spans + 3;
  const Real length = t.back();
  constexpr Real kEnds = 1e6, kStiffness = 1e-6;
  std::vector<Triplet> entries;
  Eigen::Matrix<Real, Eigen::Dynamic, Point::RowsAtCompileTime> right(n, Point::RowsAtCompileTime);
  right.setZero();
  for (std::size_t k = 0; k < t.size(); ++k) {
    const bool end = k == 0 || k + 1 == t.size();
    const Real before = k > 0 ? t[k] - t[k - 1] : 0, after = k + 1 < t.size() ? t[k + 1] - t[k] : 0;
    const Real weight = (before + after) / (2 * length) * spans * (end ? kEnds : 1) + (end ? kEnds : 0);
    const CubicWeights w = cubic_weights(t[k] / length * spans, spans);
    for (int i = 0; i < 4; ++i) {
      right.row(w.first + i) += weight * w.value[i] * point[k].transpose();
      for (int j = 0; j < 4; ++j) entries.emplace_back(w.first + i, w.first + j, weight * w.value[i] * w.value[j]);
    }
  }
  constexpr Real kBend[3] = {1, -2, 1};
  for (int i = 0; i + 2 < n; ++i)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) entries.emplace_back(i + a, i + b, kStiffness * kBend[a] * kBend[b]);
  Sparse matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLDLT<Sparse> solver(matrix);
  if (solver.info() != Eigen::Success) throw Error(ErrorCode::numeric, "a curve could not be fitted");
  const auto solved = solver.solve(right).eval();
  SplineCurve<Point> curve;
  curve.length = length;
  curve.control.resize(n);
  for (int i = 0; i < n; ++i) curve.control[i] = solved.row(i).transpose();
  std::vector<Point>& d = curve.control;
  d[0] = 6 * point.front() - 4 * d[1] - d[2];
  d[n - 1] = 6 * point.back() - 4 * d[n - 2] - d[n - 3];
  return curve;
}

// Rows of the normal equations: 49 neighbours each, by their offsets in u and v.
class Stencils {
 public:
  explicit Stencils(const SplineDomain& domain)
      : nu_(domain.u_count()), nv_(domain.v_count()), value_(domain.count() * 49, 0) {}

  void add(int i, int j, int i2, int j2, Real value) {
    value_[(static_cast<std::size_t>(i) * nv_ + j) * 49 + (i2 - i + 3) * 7 + (j2 - j + 3)] += value;
  }
  // The lower half.
  Sparse matrix() const {
    std::vector<Triplet> entries;
    entries.reserve(value_.size() / 2);
    for (int i = 0; i < nu_; ++i)
      for (int j = 0; j < nv_; ++j)
        for (int di = -3; di <= 3; ++di)
          for (int dj = -3; dj <= 3; ++dj) {
            const int row = i * nv_ + j, column = (i + di) * nv_ + (j + dj);
            if (i + di < 0 || i + di >= nu_ || j + dj < 0 || j + dj >= nv_ || column > row) continue;
            const Real v = value_[static_cast<std::size_t>(row) * 49 + (di + 3) * 7 + (dj + 3)];
            if (v != 0 || column == row) entries.emplace_back(row, column, v);
          }
    Sparse matrix(nu_ * nv_, nu_ * nv_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

 private:
  int nu_, nv_;
  std::vector<Real> value_;
};

// Squared second differences of the control points, scaled as the thin plate energy of the surface.
void add_thin_plate(const SplineDomain& domain, Real stiffness, Stencils& rows) {
  const int nu = domain.u_count(), nv = domain.v_count();
  const Real hu = domain.u_step(), hv = domain.v_step(), cell = hu * hv;
  const Real factor = std::pow(stiffness * std::sqrt(cell), 4) * cell;
  const Real uu = factor / std::pow(hu, 4), vv = factor / std::pow(hv, 4), uv = 2 * factor / (hu * hu * hv * hv);
  constexpr Real kBend[3] = {1, -2, 1};
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
          if (i + 2 < nu) rows.add(i + a, j, i + b, j, uu * kBend[a] * kBend[b]);
          if (j + 2 < nv) rows.add(i, j + a, i, j + b, vv * kBend[a] * kBend[b]);
        }
      if (i + 1 < nu && j + 1 < nv)
        for (int a = 0; a < 4; ++a)
          for (int b = 0; b < 4; ++b) {
            const Real sign = ((a / 2 + a % 2 + b / 2 + b % 2) % 2) ? -1 : 1;
            rows.add(i + a / 2, j + a % 2, i + b / 2, j + b % 2, sign * uv);
          }
    }
}

}  // namespace

SplineCurve<Vec2> fit_curve(std::span<const Real> t, std::span<const Vec2> point, int spans) {
  return fit<Vec2>(t, point, spans);
}
SplineCurve<Vec3> fit_curve(std::span<const Real> t, std::span<const Vec3> point, int spans) {
  return fit<Vec3>(t, point, spans);
}

SplineSurface fit_surface(const SplineDomain& domain, const SurfaceSamples& samples, Real stiffness) {
  const int nv = domain.v_count();
  Stencils rows(domain);
  Eigen::Matrix<Real, Eigen::Dynamic, 3> right(domain.count(), 3);
  right.setZero();
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const CubicWeights a = domain.u_weights(samples.uv[k].x()), b = domain.v_weights(samples.uv[k].y());
    for (int i = 0; i < 16; ++i) {
      const Real wi = samples.weight[k] * a.value[i / 4] * b.value[i % 4];
      right.row((a.first + i / 4) * nv + b.first + i % 4) += wi * samples.point[k].transpose();
      for (int j = 0; j < 16; ++j)
        rows.add(a.first + i / 4, b.first + i % 4, a.first + j / 4, b.first + j % 4,
                 wi * a.value[j / 4] * b.value[j % 4]);
    }
  }
  add_thin_plate(domain, stiffness, rows);
  Eigen::SimplicialLDLT<Sparse> solver(rows.matrix());
  if (solver.info() != Eigen::Success) throw Error(ErrorCode::numeric, "a surface could not be fitted");
  const auto solved = solver.solve(right).eval();
  SplineSurface surface;
  surface.domain = domain;
  surface.control.resize(domain.count());
  for (std::size_t i = 0; i < surface.control.size(); ++i) surface.control[i] = solved.row(i).transpose();
  return surface;
}

}  // namespace intarsia::tools
