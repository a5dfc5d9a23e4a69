#include "kernels/ridges/curvature_falloff.h"

#include <algorithm>
#include <cmath>

namespace intarsia::kernels {
namespace {

constexpr Real kDistance = 1.5;  // in radii of curvature: beyond a fillet of 90 degrees, which ends at pi / 4
constexpr int kMostSteps = 256;

Index walk_towards(const MeshView& mesh, Index v, const Vec3& target) {
  Real best = (mesh.point(v) - target).squaredNorm();
  for (int step = 0; step < kMostSteps; ++step) {
    Index next = kNone;
    for (Index w : mesh.vertex_vertices.row(v)) {
      const Real d = (mesh.point(w) - target).squaredNorm();
      if (d < best) best = d, next = w;
    }
    if (next == kNone) break;
    v = next;
  }
  return v;
}

}  // namespace

// The walk to a close point on the same side of the surface has done most of the way.
Index CurvatureFalloff::start_for(Index from, const Vec3& p, const Vec3& target, Real distance) const {
  if (reached_[0] == kNone || (p - last_).norm() > 0.25 * distance) return from;
  if (crest_.fields.normal[from].dot(last_normal_) < 0.8) return from;
  const Index nearer =
      (mesh_.point(reached_[0]) - target).squaredNorm() <= (mesh_.point(reached_[1]) - target).squaredNorm()
          ? reached_[0]
          : reached_[1];
  return (mesh_.point(nearer) - target).norm() < 0.5 * distance ? nearer : from;
}

Real CurvatureFalloff::at(Index from, const Vec3& p, const Vec3& across, Real k) {
  const Vec3 normal = crest_.fields.normal[from], along = normal.cross(across);
  const Real distance = kDistance / k;
  std::array<Index, 2> reached;
  Real fallen = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    const Vec3 target = p + (side == 0 ? -distance : distance) * across;
    const Index v = reached[side] = walk_towards(mesh_, start_for(from, p, target, distance), target);
    // On a round body `across` itself turns on the way; the crest's own direction stays.
    const bool aligned = std::abs(crest_.t(v).dot(along)) < 0.7;
    const Real beside = aligned ? crest_.k(v) : std::min(crest_.k(v), crest_.other_k(v));
    fallen += std::clamp(1 - beside / k, Real(0), Real(1));
  }
  reached_ = reached, last_ = p, last_normal_ = normal;
  return fallen / 2;
}

}  // namespace intarsia::kernels
