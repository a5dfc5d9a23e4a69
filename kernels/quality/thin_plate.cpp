#include "kernels/quality/thin_plate.h"

#include <algorithm>
#include <cmath>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace intarsia::kernels {
namespace {

constexpr Real kLeastWeight = 0.02, kMostWeight = 50, kGhostStep = 0.25;

using Matrix = Eigen::SparseMatrix<Real>;

// Points in one list: border, inner, ghosts.
class Plate {
 public:
  Plate(std::span<const Vec3> point, Index border, std::span<const std::array<Index, 3>> triangle,
        std::span<const Index> next, const GhostRow& ghost)
      : point_(point.begin(), point.end()), border_(border), inner_(static_cast<Index>(point.size()) - border) {
    triangle_.assign(triangle.begin(), triangle.end());
    std::vector<Index> id(border, kNone);
    std::vector<int> strips(border, 0);
    for (Index i = 0; i < border; ++i)
      if (ghost.has[i]) {
        id[i] = static_cast<Index>(point_.size());
        point_.push_back(point_[i] + ghost.outward[i]);
        outward_.push_back({i, ghost.outward[i]});
      }
    for (Index i = 0; i < border; ++i) {
      const Index j = next[i];
      if (id[i] == kNone || id[j] == kNone) continue;
      triangle_.push_back({j, i, id[i]});
      triangle_.push_back({j, id[i], id[j]});
      ++strips[i], ++strips[j];
    }
    // Rows of the Laplacian: inner points, and border points with a whole ring.
    has_row_.assign(point_.size(), 0);
    for (Index v = border; v < border + inner_; ++v) has_row_[v] = 1;
    for (Index i = 0; i < border; ++i) has_row_[i] = strips[i] == 2 ? 1 : 0;
    link();
  }

  // uniform: every neighbour counts the same. bent: the Laplacian is to be the curvature that is known at the border,
  // spread evenly, in the direction of the last normals; else 0. False if the system could not be solved.
  bool solve(bool uniform, bool bent) {
    // With uniform weights ghosts must be as far away as other neighbours. With others they are nearer: the slope they
    // give is that at their middle.
    for (std::size_t g = 0; g < outward_.size(); ++g)
      point_[border_ + inner_ + g] = point_[outward_[g].at] + (uniform ? 1 : kGhostStep) * outward_[g].step;
    weigh(uniform);
    if (bent && !spread_curvature()) return false;
    std::vector<Eigen::Triplet<Real>> entry;
    Eigen::Matrix<Real, Eigen::Dynamic, 3> right = Eigen::Matrix<Real, Eigen::Dynamic, 3>::Zero(inner_, 3);
    for (Index v = 0; v < point_.size(); ++v) {
      if (!has_row_[v]) continue;
      // The row's entries: neighbours with their weights, the point itself with minus their sum.
      row_.clear();
      Real sum = 0;
      for (Index n = first_[v]; n < first_[v + 1]; ++n) row_.push_back({neighbour_[n], weight_[n]}), sum += weight_[n];
      row_.push_back({v, -sum});
      const Real scale = 1 / mass_[v];
      Vec3 fixed = bent ? Vec3(-mass_[v] * curvature_[v] * normal_[v]) : Vec3(Vec3::Zero());
      for (const auto& [u, w] : row_)
        if (!is_inner(u)) fixed += w * point_[u];
      for (const auto& [u, w] : row_) {
        if (!is_inner(u)) continue;
        right.row(u - border_) -= (scale * w) * fixed.transpose();
        for (const auto& [x, y] : row_)
          if (is_inner(x) && x <= u) entry.emplace_back(u - border_, x - border_, scale * w * y);
      }
    }
    Matrix system(inner_, inner_);
    system.setFromTriplets(entry.begin(), entry.end());
    if (!analysed_) solver_.analyzePattern(system), analysed_ = true;
    solver_.factorize(system);
    if (solver_.info() != Eigen::Success) return false;
    const Eigen::Matrix<Real, Eigen::Dynamic, 3> x = solver_.solve(right);
    if (!x.allFinite()) return false;
    for (Index i = 0; i < inner_; ++i) point_[border_ + i] = x.row(i).transpose();
    return true;
  }

  std::vector<Vec3> inner() const { return {point_.begin() + border_, point_.begin() + border_ + inner_}; }

 private:
  bool is_inner(Index v) const { return v >= border_ && v < border_ + inner_; }

  // Neighbours of every point, ascending.
  void link() {
    std::vector<std::array<Index, 2>> pair;
    pair.reserve(6 * triangle_.size());
    for (const auto& t : triangle_)
      for (std::size_t i = 0; i < 3; ++i) {
        pair.push_back({t[i], t[(i + 1) % 3]});
        pair.push_back({t[(i + 1) % 3], t[i]});
      }
    std::sort(pair.begin(), pair.end());
    pair.erase(std::unique(pair.begin(), pair.end()), pair.end());
    first_.assign(point_.size() + 1, 0);
    for (const auto& p : pair) ++first_[p[0] + 1], neighbour_.push_back(p[1]);
    for (std::size_t v = 0; v < point_.size(); ++v) first_[v + 1] += first_[v];
    weight_.resize(neighbour_.size());
    mass_.resize(point_.size());
  }
  Real& weight_of(Index a, Index b) {
    const auto begin = neighbour_.begin() + first_[a], end = neighbour_.begin() + first_[a + 1];
    return weight_[static_cast<std::size_t>(std::lower_bound(begin, end, b) - neighbour_.begin())];
  }

  // The signed length of the Laplacian at border points with a whole ring, continued harmonically inside.
  bool spread_curvature() {
    normal_.assign(point_.size(), Vec3::Zero());
    for (const auto& t : triangle_) {
      const Vec3 n = (point_[t[1]] - point_[t[0]]).cross(point_[t[2]] - point_[t[0]]);
      for (const Index v : t) normal_[v] += n;
    }
    curvature_.assign(point_.size(), 0);
    for (Index v = 0; v < point_.size(); ++v) {
      const Real length = normal_[v].norm();
      if (length > 0) normal_[v] /= length;
      if (!has_row_[v] || is_inner(v)) continue;
      Vec3 laplacian = Vec3::Zero();
      for (Index n = first_[v]; n < first_[v + 1]; ++n) laplacian += weight_[n] * (point_[neighbour_[n]] - point_[v]);
      curvature_[v] = laplacian.dot(normal_[v]) / mass_[v];
    }
    std::vector<Eigen::Triplet<Real>> entry;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(inner_);
    for (Index v = border_; v < border_ + inner_; ++v) {
      Real sum = 0;
      for (Index n = first_[v]; n < first_[v + 1]; ++n) {
        const Index u = neighbour_[n];
        if (!is_inner(u) && !has_row_[u]) continue;
        sum += weight_[n];
        if (!is_inner(u))
          right[v - border_] += weight_[n] * curvature_[u];
        else if (u < v)
          entry.emplace_back(v - border_, u - border_, -weight_[n]);
      }
      entry.emplace_back(v - border_, v - border_, sum > 0 ? sum * (1 + 1e-9) : 1);
    }
    Matrix system(inner_, inner_);
    system.setFromTriplets(entry.begin(), entry.end());
    Eigen::SimplicialLDLT<Matrix, Eigen::Lower> solver(system);
    if (solver.info() != Eigen::Success) return false;
    const Eigen::VectorXd x = solver.solve(right);
    if (!x.allFinite()) return false;
    for (Index i = 0; i < inner_; ++i) curvature_[border_ + i] = x[i];
    return true;
  }

  void weigh(bool uniform) {
    if (uniform) {
      for (Index v = 0; v < point_.size(); ++v)
        for (Index n = first_[v]; n < first_[v + 1]; ++n) weight_[n] = Real(1) / (first_[v + 1] - first_[v]);
      std::fill(mass_.begin(), mass_.end(), Real(1));
      return;
    }
    std::fill(weight_.begin(), weight_.end(), Real(0));
    std::fill(mass_.begin(), mass_.end(), Real(0));
    Real total = 0;
    for (const auto& t : triangle_) {
      const Real twice = (point_[t[1]] - point_[t[0]]).cross(point_[t[2]] - point_[t[0]]).norm();
      total += twice / 2;
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
        mass_[a] += twice / 6;
        const Vec3 u = point_[b] - point_[a], v = point_[c] - point_[a];
        const Real half_cotangent =
            u.dot(v) / (2 * std::max(twice, Real(1e-9) * (u.squaredNorm() + v.squaredNorm())) + Real(1e-300));
        weight_of(b, c) += half_cotangent, weight_of(c, b) += half_cotangent;
      }
    }
    for (Real& w : weight_) w = std::clamp(w, kLeastWeight, kMostWeight);
    const Real least = std::max(total / (1000 * static_cast<Real>(point_.size())), Real(1e-300));
    for (Real& m : mass_) m = std::max(m, least);
  }

  struct Outward {
    Index at;
    Vec3 step;
  };
  struct Entry {
    Index point;
    Real weight;
  };

  std::vector<Vec3> point_;
  Index border_, inner_;
  std::vector<std::array<Index, 3>> triangle_;
  std::vector<std::uint8_t> has_row_;
  std::vector<Index> first_, neighbour_;
  std::vector<Real> weight_, mass_;
  std::vector<Entry> row_;
  std::vector<Outward> outward_;  // per ghost
  std::vector<Vec3> normal_;
  std::vector<Real> curvature_;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> solver_;
  bool analysed_ = false;
};

}  // namespace

std::vector<std::vector<Vec3>> solve_thin_plate(std::span<const Vec3> point, Index border,
                                                std::span<const std::array<Index, 3>> triangle,
                                                std::span<const Index> next, const GhostRow& ghost,
                                                const PlateOptions& options) {
  std::vector<std::vector<Vec3>> shapes;
  if (point.size() == border) return shapes;
  Plate plate(point, border, triangle, next, ghost);
  for (int round = 0; round < options.flat_rounds + options.bent_rounds; ++round) {
    const bool bent = round >= options.flat_rounds;
    if (!plate.solve(round == 0 && !bent, bent)) break;
    shapes.push_back(plate.inner());
  }
  return shapes;
}

}  // namespace intarsia::kernels
