// The point of a surface that is farthest from another surface, with a proof of how much farther any other may be.
#pragma once

#include <span>

#include "engine/space/triangle_tree.h"

namespace intarsia::kernels {

struct FarthestOptions {
  Real tolerance = 1e-3;  // stop when no point is farther than (1 + tolerance) x what was found
  Index splits = 4096;    // pieces split at most, those first that may hide the largest distances
};

// What is known of the surface before: distances at its vertices and at samples.
struct KnownDistances {
  std::span<const Real> vertex;           // per point
  std::span<const Index> vertex_nearest;  // per point: the other surface's triangle nearest to it; kNone: unused
  std::span<const Index> face_nearest;    // per triangle: a triangle of the other surface near to it, or kNone
};

struct Farthest {
  Real distance = 0;
  Real bound = 0;  // of all points of the surface
  Vec3 point = Vec3::Zero();
  Index triangle = kNone;
};

// Branch and bound over pieces of triangles (Guthe, Borodin, Klein 2005; Tang, Lee, Kim 2009). A piece with corners p_i
// is nowhere farther than max d(p_i) + longest side / sqrt 3, nor than max over i of the distance of p_i to any one
// triangle of the other surface (distances to a convex set are convex). Pieces that may hide more than was found are
// split into four.
// found: the farthest of the known points; triangles without vertex distances are skipped.
Farthest farthest_point(const Work& work, const TrianglesView& surface, const KnownDistances& known,
                        const TrianglesView& other, const TriangleTree& other_tree, const Farthest& found,
                        const FarthestOptions& options);

}  // namespace intarsia::kernels
