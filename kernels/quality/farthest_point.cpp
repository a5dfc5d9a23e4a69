#include "kernels/quality/farthest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "engine/parallel/compact.h"
#include "engine/parallel/reduce.h"
#include "engine/space/point_triangle.h"

namespace intarsia::kernels {
namespace {

constexpr Index kRound = 2048;  // pieces split side by side

struct Piece {
  std::array<Vec3, 3> corner;
  std::array<Real, 3> distance;
  std::array<Index, 3> nearest;
  Index triangle = kNone;   // of the surface
  Index candidate = kNone;  // a triangle of the other surface that gave its parent a good bound
  Real bound = 0;
};

class Search {
 public:
  Search(const Work& work, const TrianglesView& surface, const KnownDistances& known, const TrianglesView& other,
         const TriangleTree& tree, const Farthest& found, const FarthestOptions& options)
      : work_(work), surface_(surface), known_(known), other_(other), tree_(tree), best_(found), options_(options) {
    best_.bound = 0;
    rounding_ = 1e-13 * extent();
  }

  Farthest run() {
    std::vector<Piece> pool = suspicious_faces();
    for (Index left = options_.splits; left > 0 && !pool.empty();) {
      const Index now = std::min({left, kRound, static_cast<Index>(pool.size())});
      split(pool, now);
      left -= now;
    }
    for (const Piece& p : pool) best_.bound = std::max(best_.bound, p.bound);
    best_.bound = std::max(best_.bound, best_.distance);
    return best_;
  }

 private:
  Real limit() const { return best_.distance * (1 + options_.tolerance) + rounding_; }

  Real extent() const {
    const auto largest = [](Real a, Real b) { return std::max(a, b); };
    return reduce(
        work_, Cost::light, surface_.corner.size(), Real{0},
        [&](std::size_t begin, std::size_t end) {
          Real most = 0;
          for (std::size_t c = begin; c < end; ++c)
            most = std::max(most, surface_.point[surface_.corner[c]].cwiseAbs().maxCoeff());
          return most;
        },
        largest);
  }

  // Fills p.bound, and p.candidate by the triangle that gave it. Stops early where the bound is low enough.
  void find_bound(Piece& p, Real enough) const {
    const auto& c = p.corner;
    const Real side2 =
        std::max({(c[1] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm()});
    p.bound = std::max({p.distance[0], p.distance[1], p.distance[2]}) + std::sqrt(side2 / 3);
    const std::array<Index, 4> candidate = {p.candidate, p.nearest[0], p.nearest[1], p.nearest[2]};
    for (std::size_t i = 0; i < candidate.size() && p.bound > enough; ++i) {
      if (candidate[i] == kNone || (i > 0 && candidate[i] == candidate[i - 1])) continue;
      const Index* t = &other_.corner[3 * std::size_t{candidate[i]}];
      Real most2 = 0;
      for (std::size_t k = 0; k < 3 && most2 < p.bound * p.bound; ++k) {
        if (candidate[i] == p.nearest[k]) {
          most2 = std::max(most2, p.distance[k] * p.distance[k]);
          continue;
        }
        const Vec3 q = closest_on_triangle(c[k], other_.point[t[0]], other_.point[t[1]], other_.point[t[2]]);
        most2 = std::max(most2, (c[k] - q).squaredNorm());
      }
      const Real bound = std::sqrt(most2);
      if (bound < p.bound) p.bound = bound, p.candidate = candidate[i];
    }
  }

  bool make_piece(std::size_t f, Piece& p) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = surface_.corner[3 * f + i];
      if (known_.vertex_nearest[v] == kNone) return false;
      p.corner[i] = surface_.point[v], p.distance[i] = known_.vertex[v], p.nearest[i] = known_.vertex_nearest[v];
    }
    p.triangle = static_cast<Index>(f), p.candidate = known_.face_nearest[f];
    return true;
  }

  std::vector<Piece> suspicious_faces() {
    const std::size_t faces = surface_.count();
    const Real enough = limit();
    std::vector<Real> bound(faces);
    for_each(work_, Cost::medium, faces, [&](std::size_t f) {
      Piece p;
      if (!make_piece(f, p)) return;
      find_bound(p, enough);
      bound[f] = p.bound;
    });
    keep_bounds_below(bound, enough);
    std::vector<Index> list = compact(work_, faces, [&](std::size_t f) { return bound[f] > enough; });
    if (list.size() > options_.splits) {  // the others can never have their turn
      std::nth_element(list.begin(), list.begin() + options_.splits, list.end(),
                       [&](Index a, Index b) { return bound[a] != bound[b] ? bound[a] > bound[b] : a < b; });
      for (std::size_t i = options_.splits; i < list.size(); ++i) best_.bound = std::max(best_.bound, bound[list[i]]);
      list.resize(options_.splits);
      std::sort(list.begin(), list.end());
    }
    std::vector<Piece> pool(list.size());
    for_each(work_, Cost::medium, list.size(), [&](std::size_t i) {
      make_piece(list[i], pool[i]);
      find_bound(pool[i], enough);
    });
    return pool;
  }

  // Pieces with bounds up to `enough` are looked at no more; their bounds stay part of the proof.
  void keep_bounds_below(std::span<const Real> bound, Real enough) {
    best_.bound = reduce(
        work_, Cost::light, bound.size(), best_.bound,
        [&](std::size_t begin, std::size_t end) {
          Real most = 0;
          for (std::size_t i = begin; i < end; ++i)
            if (bound[i] <= enough) most = std::max(most, bound[i]);
          return most;
        },
        [](Real a, Real b) { return std::max(a, b); });
  }

  // Replaces the `count` pieces of the largest bounds by their children, and drops what can hide nothing any more.
  void split(std::vector<Piece>& pool, Index count) {
    std::vector<Index> order(pool.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::nth_element(order.begin(), order.begin() + (count - 1), order.end(), [&](Index a, Index b) {
      return pool[a].bound != pool[b].bound ? pool[a].bound > pool[b].bound : a < b;
    });
    std::sort(order.begin(), order.begin() + count);
    std::vector<Piece> child(4 * std::size_t{count});
    for_each(work_, Cost::heavy, count, [&](std::size_t i) { make_children(pool[order[i]], &child[4 * i]); });
    for (const Piece& p : child)
      for (std::size_t i = 0; i < 3; ++i)
        if (p.distance[i] > best_.distance)
          best_.distance = p.distance[i], best_.point = p.corner[i], best_.triangle = p.triangle;
    const Real enough = limit();
    for_each(work_, Cost::heavy, child.size(), [&](std::size_t i) { find_bound(child[i], enough); });
    for (Index i = 0; i < count; ++i) pool[order[i]].bound = 0;  // its children stand for it
    pool.insert(pool.end(), child.begin(), child.end());
    std::erase_if(pool, [&](const Piece& p) {
      if (p.bound > enough) return false;
      best_.bound = std::max(best_.bound, p.bound);
      return true;
    });
    work_.check();
  }

  void make_children(const Piece& p, Piece* child) const {
    std::array<Vec3, 3> middle;  // opposite the corner
    std::array<Real, 3> distance;
    std::array<Index, 3> nearest;
    for (std::size_t i = 0; i < 3; ++i) {
      middle[i] = 0.5 * (p.corner[(i + 1) % 3] + p.corner[(i + 2) % 3]);
      const ClosestTriangle found = tree_.closest(middle[i], p.nearest[(i + 1) % 3]);
      distance[i] = std::sqrt(found.distance2), nearest[i] = found.triangle;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      child[i] = p;
      for (std::size_t k = 1; k < 3; ++k) {
        const std::size_t at = (i + k) % 3, m = (i + 3 - k) % 3;  // the middle of the side from corner i to corner at
        child[i].corner[at] = middle[m], child[i].distance[at] = distance[m], child[i].nearest[at] = nearest[m];
      }
    }
    child[3] = p;
    child[3].corner = middle, child[3].distance = distance, child[3].nearest = nearest;
  }

  const Work& work_;
  const TrianglesView& surface_;
  const KnownDistances& known_;
  const TrianglesView& other_;
  const TriangleTree& tree_;
  Farthest best_;
  FarthestOptions options_;
  Real rounding_ = 0;
};

}  // namespace

Farthest farthest_point(const Work& work, const TrianglesView& surface, const KnownDistances& known,
                        const TrianglesView& other, const TriangleTree& other_tree, const Farthest& found,
                        const FarthestOptions& options) {
  return Search(work, surface, known, other, other_tree, found, options).run();
}

}  // namespace intarsia::kernels
