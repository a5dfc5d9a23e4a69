// Closest triangle queries: a bounding volume hierarchy over any triangles.
#pragma once

#include <memory>
#include <span>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia {

// Triangles without connectivity. Nothing is copied.
struct TrianglesView {
  Vec3View point;
  std::span<const Index> corner;  // 3 per triangle

  Index count() const { return static_cast<Index>(corner.size() / 3); }
};

struct ClosestTriangle {
  Index triangle = kNone;
  Real distance2 = 0;
  Vec3 point = Vec3::Zero();
};

// Built in parallel; the same for any number of threads. Queries are const and may run side by side. Answers are exact
// (that of a search through all triangles); equally near triangles: the smallest id.
class TriangleTree {
 public:
  // Copies what it needs of the triangles. Degenerate ones count as segments and points.
  // Requires: at least one triangle, finite points.
  TriangleTree(const Work& work, const TrianglesView& triangles);
  ~TriangleTree();
  TriangleTree(TriangleTree&&) noexcept;
  TriangleTree& operator=(TriangleTree&&) noexcept;

  // hint: a triangle that is likely near, for example that of a neighbouring query; it changes the time, not the
  // answer.
  ClosestTriangle closest(const Vec3& p, Index hint = kNone) const;

  // First triangle hit by the ray from origin along the unit direction, farther than `least`; distance, or infinity.
  Real first_hit(const Vec3& origin, const Vec3& direction, Real least) const;

  // All triangles, neighbours in space near each other: the order in which hints help most.
  std::span<const Index> order() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace intarsia
