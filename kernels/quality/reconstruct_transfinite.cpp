#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/quality/patch_border.h"
#include "kernels/quality/refine_patch.h"
#include "kernels/quality/transfinite_patch.h"

namespace intarsia::kernels {
namespace {

constexpr Real kTurnReach = 0.04;  // of the border: chords between which a corner's turn is measured

// Sides as runs of border positions: side i is corner[i] .. corner[i + 1] (cyclic).
class Sides {
 public:
  Sides(const PatchBorder& border, const TransfiniteOptions& options) : border_(border), options_(options) {
    for (std::size_t s = 0; s + 1 < border.side.size(); ++s) corner_.push_back(border.side[s]);
    const Index most = std::max(Index{3}, options.most_sides);
    while (corner_.size() > 3 && drop_straightest(corner_.size() > most ? 180 : options.straight)) {
    }
    while (corner_.size() < 3 && split_longest(0)) {
    }
    while (options.long_side > 0 && corner_.size() < most && split_longest(options.long_side * median())) {
    }
  }

  Index count() const { return static_cast<Index>(corner_.size()); }
  Index first(Index i) const { return corner_[i % corner_.size()]; }
  Index segments(Index i) const {
    if (corner_.size() == 1) return border_.size();
    return (first(i + 1) + border_.size() - first(i)) % border_.size();
  }
  SideCurve curve(Index i) const {
    std::vector<Vec3> point;
    for (Index s = 0; s <= segments(i); ++s) point.push_back(border_.point[(first(i) + s) % border_.size()]);
    return SideCurve(std::move(point));
  }

 private:
  Real median() const {
    std::vector<Real> length;
    for (Index i = 0; i < count(); ++i) length.push_back(curve(i).length());
    std::sort(length.begin(), length.end());
    return (length[(length.size() - 1) / 2] + length[length.size() / 2]) / 2;
  }
  // False if all turn more than `angle`, in degrees.
  bool drop_straightest(Real angle) {
    Index straightest = 0;
    Real most = -2;
    const Index n = border_.size();
    const Index reach = std::max(Index{1}, static_cast<Index>(kTurnReach * static_cast<Real>(n)));
    for (Index i = 0; i < count(); ++i) {
      const Vec3 at = border_.point[corner_[i]];
      const Vec3 in = at - border_.point[(corner_[i] + n - reach) % n];
      const Vec3 out = border_.point[(corner_[i] + reach) % n] - at;
      const Real scale = in.norm() * out.norm(), cosine = scale > 0 ? in.dot(out) / scale : 1;
      if (cosine > most) most = cosine, straightest = i;
    }
    if (most < std::cos(angle * std::numbers::pi / 180)) return false;
    corner_.erase(corner_.begin() + straightest);
    return true;
  }
  // At the sample nearest to its middle; false if no side that can be cut is longer than `least`.
  bool split_longest(Real least) {
    Index longest = kNone;
    Real most = least;
    for (Index i = 0; i < count(); ++i)
      if (segments(i) >= 2 && (curve(i).length() > most || (longest == kNone && least == 0)))
        most = curve(i).length(), longest = i;
    if (longest == kNone) return false;
    const SideCurve side = curve(longest);
    Index middle = 1;
    for (Index s = 1; s < side.segments(); ++s)
      if (std::abs(side.parameter(s) - 0.5) < std::abs(side.parameter(middle) - 0.5)) middle = s;
    corner_.insert(corner_.begin() + longest + 1, (first(longest) + middle) % border_.size());
    return true;
  }

  const PatchBorder& border_;
  const TransfiniteOptions& options_;
  std::vector<Index> corner_;
};

// The domain polygon with the samples on its sides, triangulated.
PatchMesh fill(const PatchBorder& border, const TransfiniteOptions& options) {
  PatchMesh mesh;
  const Sides sides(border, options);
  if (sides.count() < 3) {
    mesh.failed = true;
    return mesh;
  }
  // Side i of the patch ends in corner i of the domain.
  std::vector<SideCurve> curve;
  for (Index i = 0; i < sides.count(); ++i) curve.push_back(sides.curve(i));
  const TransfinitePatch patch(std::move(curve));
  const Index n = border.size();
  std::vector<Vec3> domain(n);
  for (Index i = 0; i < sides.count(); ++i)
    for (Index s = 0; s < sides.segments(i); ++s)
      domain[(sides.first(i) + s) % n] = patch.on_side(i, patch.side(i).parameter(s));
  domain.push_back(Vec3::Zero());
  for (Index i = 0; i < n; ++i) mesh.triangle.push_back({i, (i + 1) % n, n});
  refine_patch(domain, mesh.triangle, {options.step, options.most_inner});
  for (std::size_t i = n; i < domain.size(); ++i) mesh.inner.push_back(patch.at(domain[i].x(), domain[i].y()));
  return mesh;
}

}  // namespace

Reconstruction reconstruct_transfinite(const Work& work, const SampledLayout& layout,
                                       const PatchTriangulations& triangulated, const TransfiniteOptions& options) {
  return rebuild(work, layout, [&](Index p, const PatchBorder& border) {
    const Triangles& flat = triangulated.triangle[p];
    if (flat.empty() || border.loops() > 1) return PatchMesh{{}, flat};
    PatchMesh mesh = fill(border, options);
    const std::vector<Vec3> start(mesh.inner.size(), border.point[0]);
    if (mesh.failed || !stays_near(mesh.inner, start, border, flat, options.guard)) return PatchMesh{{}, flat, true};
    return mesh;
  });
}

}  // namespace intarsia::kernels
