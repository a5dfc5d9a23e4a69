// Arrays over a refined mesh that say something new only where the refinement or its network is: stored by what differs
// from the rest, read like plain arrays.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "engine/data/surface_point.h"

namespace intarsia {

// Where each refined vertex sits on the original mesh. The first ones are the original vertices themselves.
class VertexOrigins {
 public:
  VertexOrigins() = default;
  VertexOrigins(Index originals, std::vector<SurfacePoint> added) : originals_(originals), added_(std::move(added)) {}

  SurfacePoint operator[](std::size_t v) const {
    return v < originals_ ? SurfacePoint::at_vertex(static_cast<Index>(v)) : added_[v - originals_];
  }
  std::size_t size() const { return originals_ + added_.size(); }
  void push_back(const SurfacePoint& p) {
    if (added_.empty() && p == SurfacePoint::at_vertex(originals_))
      ++originals_;
    else
      added_.push_back(p);
  }
  Index originals() const { return originals_; }
  const std::vector<SurfacePoint>& added() const { return added_; }
  // For engine/base/fields.h.
  template <class F>
  void visit_fields(F&& f) {
    f(originals_), f(added_);
  }
  template <class F>
  void visit_fields(F&& f) const {
    f(originals_), f(added_);
  }

 private:
  Index originals_ = 0;
  std::vector<SurfacePoint> added_;
};

// One number per edge, zero for all but a few.
class EdgeStrengths {
 public:
  Real operator[](std::size_t e) const {
    const auto at = std::lower_bound(edge_.begin(), edge_.end(), static_cast<Index>(e));
    return at != edge_.end() && *at == e ? value_[static_cast<std::size_t>(at - edge_.begin())] : 0;
  }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  // Edges that come with this have strength 0. Requires: at least size().
  void resize(std::size_t edges) { size_ = edges; }
  void push_back(Real value) { set(size_++, value); }
  // In constant time where e is behind all edges set before.
  void set(std::size_t e, Real value) {
    const auto at = std::lower_bound(edge_.begin(), edge_.end(), static_cast<Index>(e));
    const auto place = at - edge_.begin();
    if (at != edge_.end() && *at == e) {
      value_[static_cast<std::size_t>(place)] = value;
    } else if (value != 0) {
      edge_.insert(at, static_cast<Index>(e));
      value_.insert(value_.begin() + place, value);
    }
  }
  const std::vector<Index>& edges() const { return edge_; }  // those set, ascending
  const std::vector<Real>& values() const { return value_; }
  // For engine/base/fields.h.
  template <class F>
  void visit_fields(F&& f) {
    f(size_), f(edge_), f(value_);
  }
  template <class F>
  void visit_fields(F&& f) const {
    f(size_), f(edge_), f(value_);
  }

 private:
  std::size_t size_ = 0;
  std::vector<Index> edge_;
  std::vector<Real> value_;
};

}  // namespace intarsia
