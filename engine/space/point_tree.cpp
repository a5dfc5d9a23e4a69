#include "engine/space/point_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <nanoflann.hpp>

namespace intarsia {

namespace {

struct Cloud {
  std::vector<Vec3> point;
  std::size_t kdtree_get_point_count() const { return point.size(); }
  Real kdtree_get_pt(std::size_t i, std::size_t axis) const { return point[i][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<Real, Cloud, Real, Index>, Cloud, 3, Index>;

Cloud copy_of(Vec3View points) {
  Cloud cloud;
  cloud.point.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) cloud.point[i] = points[i];
  return cloud;
}

}  // namespace

struct PointTree::Impl {
  explicit Impl(Vec3View points) : cloud(copy_of(points)), tree(3, cloud) {}

  // Calls found(id, squared distance) for a closed ball that may be a rounding error too large.
  std::vector<std::pair<Index, Real>> ball(const Vec3& p, Real squared) const {
    std::vector<std::pair<Index, Real>> hits;
    nanoflann::SearchParams params;
    params.sorted = false;
    // The library keeps distances strictly below the bound.
    const Real bound = std::nextafter(squared, std::numeric_limits<Real>::infinity());
    tree.radiusSearch(p.data(), bound, hits, params);
    return hits;
  }

  Cloud cloud;
  Tree tree;
};

PointTree::PointTree(Vec3View points) : impl_(std::make_unique<Impl>(points)) {}
PointTree::~PointTree() = default;
PointTree::PointTree(PointTree&&) noexcept = default;
PointTree& PointTree::operator=(PointTree&&) noexcept = default;

Index PointTree::size() const { return static_cast<Index>(impl_->cloud.point.size()); }

Index PointTree::nearest(const Vec3& p) const {
  if (impl_->cloud.point.empty()) return kNone;
  Index id = 0;
  Real squared = 0;
  impl_->tree.knnSearch(p.data(), 1, &id, &squared);
  for (const auto& [other, d] : impl_->ball(p, squared))
    if (d <= squared) id = std::min(id, other);
  return id;
}

void PointTree::in_radius(const Vec3& p, Real radius, std::vector<Index>& out) const {
  out.clear();
  if (impl_->cloud.point.empty() || !(radius >= 0)) return;
  for (const auto& hit : impl_->ball(p, radius * radius)) out.push_back(hit.first);
  std::sort(out.begin(), out.end());
}

}  // namespace intarsia
