#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/quality/patch_border.h"
#include "kernels/quality/refine_patch.h"
#include "kernels/quality/transfinite_patch.h"

namespace intarsia::kernels {
namespace {

constexpr Real kTurnReach = 0.04;  // of the border: chords between which a corner's turn is measured

// A part of a patch: a loop of points, some of them corners, and its part of the triangulation.
struct Piece {
  std::vector<Index> vertex;
  std::vector<std::uint8_t> is_corner;  // per vertex of the loop
  Triangles triangle;

  Index size() const { return static_cast<Index>(vertex.size()); }
};

// Sides as runs of positions of a loop: side i is corner[i] .. corner[i + 1] (cyclic).
class Sides {
 public:
  Sides(std::vector<Vec3> loop, const std::vector<std::uint8_t>& is_corner, const TransfiniteOptions& options)
      : loop_(std::move(loop)) {
    for (Index i = 0; i < loop_.size(); ++i)
      if (is_corner[i]) corner_.push_back(i);
    if (corner_.empty()) corner_.push_back(0);
    const Index most = std::max(Index{3}, options.most_sides);
    while (corner_.size() > 3 && drop_straightest(corner_.size() > most ? 180 : options.straight)) {
    }
    while (corner_.size() < 3 && split_longest()) {
    }
  }

  Index count() const { return static_cast<Index>(corner_.size()); }
  Index first(Index i) const { return corner_[i % corner_.size()]; }
  Index segments(Index i) const {
    const Index n = static_cast<Index>(loop_.size());
    return corner_.size() == 1 ? n : (first(i + 1) + n - first(i)) % n;
  }
  SideCurve curve(Index i) const {
    std::vector<Vec3> point;
    for (Index s = 0; s <= segments(i); ++s) point.push_back(loop_[(first(i) + s) % loop_.size()]);
    return SideCurve(std::move(point));
  }

 private:
  // False if all turn more than `angle`, in degrees.
  bool drop_straightest(Real angle) {
    Index straightest = 0;
    Real most = -2;
    const std::size_t n = loop_.size();
    const std::size_t reach = std::max<std::size_t>(1, static_cast<std::size_t>(kTurnReach * static_cast<Real>(n)));
    for (Index i = 0; i < count(); ++i) {
      const Vec3 at = loop_[corner_[i]];
      const Vec3 in = at - loop_[(corner_[i] + n - reach) % n], out = loop_[(corner_[i] + reach) % n] - at;
      const Real scale = in.norm() * out.norm(), cosine = scale > 0 ? in.dot(out) / scale : 1;
      if (cosine > most) most = cosine, straightest = i;
    }
    if (most < std::cos(angle * std::numbers::pi / 180)) return false;
    corner_.erase(corner_.begin() + straightest);
    return true;
  }
  // At the sample nearest to its middle; false if no side can be cut.
  bool split_longest() {
    Index longest = kNone;
    Real most = -1;
    for (Index i = 0; i < count(); ++i)
      if (segments(i) >= 2 && curve(i).length() > most) most = curve(i).length(), longest = i;
    if (longest == kNone) return false;
    const SideCurve side = curve(longest);
    Index middle = 1;
    for (Index s = 1; s < side.segments(); ++s)
      if (std::abs(side.parameter(s) - 0.5) < std::abs(side.parameter(middle) - 0.5)) middle = s;
    corner_.insert(corner_.begin() + longest + 1, (first(longest) + middle) % static_cast<Index>(loop_.size()));
    return true;
  }

  std::vector<Vec3> loop_;
  std::vector<Index> corner_;
};

// Transfinite patches for a whole patch, or for the parts it is cut into where one would stray.
class PatchFiller {
 public:
  PatchFiller(const PatchBorder& border, const Triangles& flat, const TransfiniteOptions& options)
      : border_(border), options_(options), point_(border.point) {
    Piece whole;
    whole.triangle = flat;
    whole.is_corner.assign(border.size(), 0);
    for (Index i = 0; i < border.size(); ++i) whole.vertex.push_back(i);
    for (std::size_t s = 0; s + 1 < border.side.size(); ++s) whole.is_corner[border.side[s]] = 1;
    open_.push_back(std::move(whole));
    for (Index i = 0; i < border.size(); ++i) step_ += (point_[(i + 1) % border.size()] - point_[i]).norm();
    step_ = options.step * step_ / border.size();
  }

  PatchMesh run() {
    PatchMesh mesh;
    while (!open_.empty()) {
      const Piece piece = std::move(open_.back());
      open_.pop_back();
      if (fill(piece, mesh)) continue;
      mesh.cut = true;
      cut(piece);
    }
    mesh.inner.assign(point_.begin() + border_.size(), point_.end());
    return mesh;
  }

 private:
  // The domain polygon with the points of the loop on its sides, triangulated. False if its shape strays.
  bool fill(const Piece& piece, PatchMesh& mesh) {
    const Index n = piece.size();
    std::vector<Vec3> loop;
    for (const Index v : piece.vertex) loop.push_back(point_[v]);
    const Real reach = options_.guard * diagonal_of(loop);
    const Sides sides(std::move(loop), piece.is_corner, options_);
    std::vector<SideCurve> curve;
    for (Index i = 0; i < sides.count(); ++i) curve.push_back(sides.curve(i));
    const TransfinitePatch patch(std::move(curve));
    std::vector<Vec3> domain(n);
    for (Index i = 0; i < sides.count(); ++i)
      for (Index s = 0; s < sides.segments(i); ++s)
        domain[(sides.first(i) + s) % n] = patch.on_side(i, patch.side(i).parameter(s));
    domain.push_back(Vec3::Zero());
    Triangles triangle;
    for (Index i = 0; i < n; ++i) triangle.push_back({i, (i + 1) % n, n});
    refine_patch(domain, triangle, {options_.step, options_.most_inner});
    std::vector<Vec3> inner;
    for (std::size_t i = n; i < domain.size(); ++i) inner.push_back(patch.at(domain[i].x(), domain[i].y()));
    if (piece.triangle.size() > 1 && !stays_near(inner, {}, point_, piece.triangle, reach)) return false;

    const Index base = static_cast<Index>(point_.size());
    point_.insert(point_.end(), inner.begin(), inner.end());
    for (const auto& t : triangle) {
      std::array<Index, 3> to{};
      for (std::size_t c = 0; c < 3; ++c) to[c] = t[c] < n ? piece.vertex[t[c]] : base + (t[c] - n);
      mesh.triangle.push_back(to);
    }
    return true;
  }

  // Along the chord of the triangulation that is shortest against the shorter of both parts' borders.
  // Requires: at least two triangles.
  void cut(const Piece& piece) {
    const Index n = piece.size();
    std::vector<Index> at(border_.size(), kNone);  // border position -> position in the loop
    for (Index i = 0; i < n; ++i)
      if (piece.vertex[i] < border_.size()) at[piece.vertex[i]] = i;
    std::vector<Real> along(n + 1, 0);
    for (Index i = 0; i < n; ++i)
      along[i + 1] = along[i] + (point_[piece.vertex[(i + 1) % n]] - point_[piece.vertex[i]]).norm();
    Index from = kNone, to = kNone;
    Real best = 0;
    for (const auto& t : piece.triangle)
      for (std::size_t c = 0; c < 3; ++c) {
        const Index a = t[c], b = t[(c + 1) % 3], i = std::min(at[a], at[b]), k = std::max(at[a], at[b]);
        if (k - i < 2 || k - i > n - 2 || is_cut(a, b)) continue;
        const Real part = along[k] - along[i], shorter = std::min(part, along[n] - part);
        const Real length = (point_[a] - point_[b]).norm();
        const Real ratio = shorter > 0 ? length / shorter : std::numeric_limits<Real>::max();
        if (from == kNone || ratio < best) best = ratio, from = i, to = k;
      }
    Piece near = part_of(piece, from, to), far = part_of(piece, to, from);
    const std::vector<Index> chord = subdivided(piece.vertex[from], piece.vertex[to]);
    for (auto v = chord.rbegin(); v != chord.rend(); ++v) near.vertex.push_back(*v), near.is_corner.push_back(0);
    for (const Index v : chord) far.vertex.push_back(v), far.is_corner.push_back(0);
    for (const auto& t : piece.triangle) {
      bool is_near = true;
      for (const Index v : t) is_near = is_near && at[v] >= from && at[v] <= to;
      (is_near ? near : far).triangle.push_back(t);
    }
    open_.push_back(std::move(far));
    open_.push_back(std::move(near));
  }

  bool is_cut(Index a, Index b) const {
    return std::find(done_.begin(), done_.end(), std::array{std::min(a, b), std::max(a, b)}) != done_.end();
  }

  // New points on the straight line between two.
  std::vector<Index> subdivided(Index a, Index b) {
    done_.push_back({std::min(a, b), std::max(a, b)});
    const Vec3 from = point_[a], to = point_[b];
    const Real steps = step_ > 0 ? std::min((to - from).norm() / step_, Real(1000)) : 1;
    const Index segments = std::max(Index{1}, static_cast<Index>(steps));
    std::vector<Index> chord;
    for (Index s = 1; s < segments; ++s) {
      chord.push_back(static_cast<Index>(point_.size()));
      point_.push_back(from + static_cast<Real>(s) / static_cast<Real>(segments) * (to - from));
    }
    return chord;
  }

  // The loop's points from one to another (cyclic), both of them corners; without triangles.
  static Piece part_of(const Piece& piece, Index from, Index to) {
    Piece part;
    for (Index i = from;; i = (i + 1) % piece.size()) {
      part.vertex.push_back(piece.vertex[i]);
      part.is_corner.push_back(i == from || i == to ? 1 : piece.is_corner[i]);
      if (i == to) return part;
    }
  }

  const PatchBorder& border_;
  const TransfiniteOptions& options_;
  std::vector<Vec3> point_;  // border, then inner points
  Real step_ = 0;
  std::vector<Piece> open_;
  std::vector<std::array<Index, 2>> done_;  // chords that were cut along
};

}  // namespace

Reconstruction reconstruct_transfinite(const Work& work, const SampledLayout& layout,
                                       const PatchTriangulations& triangulated, const TransfiniteOptions& options) {
  return rebuild(work, layout, [&](Index p, const PatchBorder& border) {
    const Triangles& flat = triangulated.triangle[p];
    if (flat.empty() || border.loops() > 1) return PatchMesh{{}, flat};
    return PatchFiller(border, flat, options).run();
  });
}

}  // namespace intarsia::kernels
