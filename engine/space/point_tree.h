// Nearest and in-radius queries over a fixed set of points.
#pragma once

#include <memory>
#include <vector>

#include "engine/data/mesh.h"

namespace intarsia {

// A k-d tree over a copy of the points. Queries are const and may run side by side; answers do not depend on how the
// tree was split: ties go to the smaller id.
class PointTree {
 public:
  explicit PointTree(Vec3View points);
  ~PointTree();
  PointTree(PointTree&&) noexcept;
  PointTree& operator=(PointTree&&) noexcept;

  Index size() const;
  // The id of the point nearest to p (the smallest id among equals), or kNone if there are no points.
  Index nearest(const Vec3& p) const;
  // Ids of all points with |x - p| <= radius, ascending, into `out` (cleared first).
  void in_radius(const Vec3& p, Real radius, std::vector<Index>& out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace intarsia
