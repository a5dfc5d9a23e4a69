// Scalable locally injective mappings (Rabinovich, Poranne, Panozzo, Sorkine-Hornung 2017), symmetric Dirichlet energy.
#include <algorithm>
#include <cmath>

#include <Eigen/SVD>
#include <Eigen/SparseCholesky>

#include "tools/step/flatten.h"

namespace intarsia::tools {
namespace {

using Mat2 = Eigen::Matrix2d;
using Sparse = Eigen::SparseMatrix<Real>;

// A triangle at rest in a plane of its own. Slivers only keep their shape as well as they can: as barriers they would
// stop everything.
struct Rest {
  std::array<Vec2, 3> gradient;  // of the corner's hat function
  Real area = 0;
  bool sliver = false;
};

class Energy {
 public:
  explicit Energy(const PatchPiece& piece) : piece_(piece), rest_(piece.triangle.size()) {
    Real mean = 0;
    for (std::size_t t = 0; t < rest_.size(); ++t) mean += normal(t).norm() / 2 / static_cast<Real>(rest_.size());
    const Real least = 1e-3 * mean;
    for (std::size_t t = 0; t < rest_.size(); ++t) {
      const auto& c = piece.triangle[t];
      const Vec3 a = piece.point[c[1]] - piece.point[c[0]], b = piece.point[c[2]] - piece.point[c[0]];
      const Real longest = std::max({a.norm(), b.norm(), (a - b).norm()});
      Real height = longest > 0 ? normal(t).norm() / longest : 0;
      Rest& r = rest_[t];
      r.sliver = height < 0.02 * longest || longest * height < 2 * least;
      const Real base = std::max(a.norm(), 1e-2 * std::sqrt(mean));
      // Corners (0, 0), (base, 0), (x, y).
      const Real x = a.norm() > 0 ? a.dot(b) / a.norm() : 0;
      const Real y = std::max(normal(t).norm() / base, r.sliver ? 0.05 * std::max(longest, base) : 0.0);
      r.area = base * y / 2;
      r.gradient = {Vec2(-1 / base, (x - base) / (base * y)), Vec2(1 / base, -x / (base * y)), Vec2(0, 1 / y)};
    }
  }

  Mat2 jacobian(std::size_t t, std::span<const Vec2> uv) const {
    const auto& c = piece_.triangle[t];
    Mat2 j = Mat2::Zero();
    for (int i = 0; i < 3; ++i) j += uv[c[i]] * rest_[t].gradient[i].transpose();
    return j;
  }
  Real value(std::span<const Vec2> uv) const {
    Real sum = 0;
    for (std::size_t t = 0; t < rest_.size(); ++t) {
      if (rest_[t].sliver) continue;
      const Mat2 j = jacobian(t, uv);
      const Real det = j.determinant();
      if (!(det > 0)) return std::numeric_limits<Real>::infinity();
      sum += rest_[t].area * j.squaredNorm() * (1 + 1 / (det * det));
    }
    return sum;
  }
  const Rest& rest(std::size_t t) const { return rest_[t]; }
  std::size_t triangles() const { return rest_.size(); }

 private:
  Vec3 normal(std::size_t t) const {
    const auto& c = piece_.triangle[t];
    return (piece_.point[c[1]] - piece_.point[c[0]]).cross(piece_.point[c[2]] - piece_.point[c[0]]);
  }
  const PatchPiece& piece_;
  std::vector<Rest> rest_;
};

// sqrt((s - s^-3) / (s - 1)), continuous at 1.
Real weight_of(Real s) {
  const Real q = 1 / std::clamp(s, 1e-6, 1e6);
  return std::sqrt((1 + q) * (1 + q * q));
}

// Largest step along `way` before a triangle that counts loses its area.
Real step_without_flip(const PatchPiece& piece, const Energy& energy, std::span<const Vec2> uv,
                       std::span<const Vec2> way) {
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  Real step = 1 / 0.8;
  for (std::size_t t = 0; t < energy.triangles(); ++t) {
    if (energy.rest(t).sliver) continue;
    const auto& i = piece.triangle[t];
    const Vec2 p = uv[i[1]] - uv[i[0]], q = uv[i[2]] - uv[i[0]], dp = way[i[1]] - way[i[0]], dq = way[i[2]] - way[i[0]];
    const Real a = cross(dp, dq), b = cross(p, dq) + cross(dp, q), c = cross(p, q);  // a t^2 + b t + c, c > 0
    const Real square = b * b - 4 * a * c;
    if (square < 0) continue;
    const Real root = std::sqrt(square), half = -(b + (b > 0 ? root : -root)) / 2;
    if (a != 0 && half / a > 0) step = std::min(step, half / a);
    if (half != 0 && c / half > 0) step = std::min(step, c / half);
  }
  return 0.8 * step;
}

}  // namespace

std::vector<Vec2> reduce_distortion(const PatchPiece& piece, std::span<const Vec2> start, int iterations) {
  const Energy energy(piece);
  const int n = static_cast<int>(piece.point.size());
  std::vector<Vec2> uv(start.begin(), start.end()), best = uv;
  Real before = energy.value(uv);
  if (!std::isfinite(before)) return best;
  Real all = 0;
  for (std::size_t t = 0; t < energy.triangles(); ++t) all += energy.rest(t).area;
  // Not LLT: where the map squeezes parts of the patch a thousandfold the weights span twenty orders of magnitude, and
  // rounding turns small pivots negative. Whatever direction comes of it, the line search takes it downhill only.
  Eigen::SimplicialLDLT<Sparse> solver;
  std::vector<Eigen::Triplet<Real, int>> entries;
  for (int round = 0; round < iterations; ++round) {
    entries.clear();
    Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * n);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 2; ++k) {
        const Real anchor = 1e-4 / n;  // the solution is free to move as a whole
        entries.emplace_back(2 * i + k, 2 * i + k, anchor);
        right(2 * i + k) += anchor * uv[i](k);
      }
    for (std::size_t t = 0; t < energy.triangles(); ++t) {
      const Rest& rest = energy.rest(t);
      const Eigen::JacobiSVD<Mat2> svd(energy.jacobian(t, uv), Eigen::ComputeFullU | Eigen::ComputeFullV);
      Mat2 u = svd.matrixU(), v = svd.matrixV();
      if ((u * v.transpose()).determinant() < 0) u.col(1) *= -1;
      const Mat2 rotation = u * v.transpose();
      Mat2 square = Mat2::Identity();  // W^T W
      if (!rest.sliver) {
        const Vec2 w(weight_of(svd.singularValues()(0)), weight_of(svd.singularValues()(1)));
        square = u * w.cwiseAbs2().asDiagonal() * u.transpose();
      }
      const Mat2 target = square * rotation;
      const auto& c = piece.triangle[t];
      const Real area = rest.area / all;
      for (int i = 0; i < 3; ++i) {
        right.segment<2>(2 * c[i]) += area * target * rest.gradient[i];
        for (int j = 0; j < 3; ++j) {
          if (c[j] > c[i]) continue;
          const Real g = area * rest.gradient[i].dot(rest.gradient[j]);
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b) {
              const int row = static_cast<int>(2 * c[i]) + a, column = static_cast<int>(2 * c[j]) + b;
              if (column <= row) entries.emplace_back(row, column, g * square(a, b));
            }
        }
      }
    }
    Sparse matrix(2 * n, 2 * n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    if (round == 0) solver.analyzePattern(matrix);
    solver.factorize(matrix);
    if (solver.info() != Eigen::Success) break;
    const Eigen::VectorXd solved = solver.solve(right);
    std::vector<Vec2> way(n);
    for (int i = 0; i < n; ++i) way[i] = solved.segment<2>(2 * i) - uv[i];
    Real step = step_without_flip(piece, energy, uv, way), after = before;
    std::vector<Vec2> next(n);
    bool found = false;
    for (int k = 0; k < 20 && !found; ++k, step /= 2) {
      for (int i = 0; i < n; ++i) next[i] = uv[i] + step * way[i];
      after = energy.value(next);
      found = after < before;
    }
    if (!found) break;
    uv = next;
    if (!borders_cross(piece, uv)) best = uv;
    const bool done = before - after < 1e-3 * before;
    before = after;
    if (done) break;
  }
  return best;
}

}  // namespace intarsia::tools
