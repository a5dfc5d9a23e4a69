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

Real curvature_falloff(const MeshView& mesh, const CrestFields& crest, Index from, const Vec3& p, const Vec3& across,
                       Real k) {
  const Vec3 along = crest.fields.normal[from].cross(across);
  Real fallen = 0;
  for (const Real side : {-1.0, 1.0}) {
    const Index v = walk_towards(mesh, from, p + side * kDistance / k * across);
    // On a round body `across` itself turns on the way; the crest's own direction stays.
    const bool aligned = std::abs(crest.t(v).dot(along)) < 0.7;
    const Real beside = aligned ? crest.k(v) : std::min(crest.k(v), crest.other_k(v));
    fallen += std::clamp(1 - beside / k, Real(0), Real(1));
  }
  return fallen / 2;
}

}  // namespace intarsia::kernels
