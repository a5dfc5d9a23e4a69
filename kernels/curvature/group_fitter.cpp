#include "kernels/curvature/group_fitter.h"

namespace intarsia::kernels {

namespace {

constexpr int kMostRings = 6;
constexpr Index kMostPoints = 4096;  // of a group, against poles that everything is next to

}  // namespace

void GroupFitter::gather(Index first, std::span<const std::uint8_t> ring, const Vec3View& normal) {
  std::array<Mask, kMostRings + 1> of_ring{};
  int most = 0;
  active_ = walked_ = 0;
  for (std::size_t b = 0; b < ring.size(); ++b) {
    const int k = std::min<int>(ring[b], kMostRings);
    if (k == 0) continue;
    most = std::max(most, k);
    active_ |= Mask{1} << b;
    if (has_normal(normal[first + b])) of_ring[static_cast<std::size_t>(k)] |= Mask{1} << b;
  }
  if (active_ == 0) return;
  if (!walker_.walk(first, static_cast<Index>(ring.size()), most, kMostPoints)) return;

  const std::span<const Index> vertices = walker_.vertices(most);
  if (points_.size() < vertices.size()) {
    points_.resize(2 * vertices.size());
    masks_.resize(2 * vertices.size());
    entries_.resize(2 * vertices.size());
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Index q = vertices[i];
    points_[i] = {mesh_.x[q], mesh_.y[q], mesh_.z[q], normal.x[q], normal.y[q], normal.z[q]};
  }
  std::fill(masks_.begin(), masks_.begin() + static_cast<std::ptrdiff_t>(vertices.size()), Mask{0});
  for (int k = 1; k <= most; ++k) {
    const Mask lanes = of_ring[static_cast<std::size_t>(k)];
    if (lanes == 0) continue;
    walked_ |= lanes;
    const std::span<const Mask> within = walker_.within(k);
    for (std::size_t i = 0; i < within.size(); ++i) masks_[i] |= within[i] & lanes;
  }
  for (std::size_t b = 0; b < ring.size(); ++b) masks_[b] &= ~(Mask{1} << b);

  // Where the cap of one vertex's walk would cut, only that walk knows how.
  if (vertices.size() > RingWalker::kFitCap) {
    std::array<Index, kGroup> count{};
    for (std::size_t i = 0; i < vertices.size(); ++i)
      for (std::size_t b = 0; b < ring.size(); ++b) count[b] += static_cast<Index>(masks_[i] >> b & 1);
    for (std::size_t b = 0; b < ring.size(); ++b)
      if (count[b] > RingWalker::kFitCap) walked_ &= ~(Mask{1} << b);
  }
  find_depths(most);
  for (std::size_t b = 0; b < ring.size(); ++b) depth_[b] = std::min(depth_[b], ring[b]);
}

// The last ring of every vertex of the group that has points: less than asked for where its component ends.
void GroupFitter::find_depths(int rings) {
  depth_.fill(0);
  Mask going = ~Mask{0};
  for (int k = 1; k <= rings && going != 0; ++k) {
    const std::span<const Mask> now = walker_.within(k), before = walker_.within(k - 1);
    Mask grown = 0;
    for (std::size_t i = 0; i < before.size(); ++i) grown |= now[i] & ~before[i];
    for (std::size_t i = before.size(); i < now.size(); ++i) grown |= now[i];
    going &= grown;
    for (std::size_t b = 0; b < kGroup; ++b) depth_[b] = static_cast<std::uint8_t>(depth_[b] + (going >> b & 1));
  }
}

void GroupFitter::fit_pack(std::size_t at, const Vec3View& normal, std::size_t terms, const FitOptions& options) {
  const std::uint32_t lanes = static_cast<std::uint32_t>(walked_ >> at) & 0xffu;
  pack_.fits.solved = 0;
  for (std::size_t l = 0; l < kLanes; ++l) {
    if ((lanes >> l & 1) == 0) continue;
    const Index v = pack_.first + static_cast<Index>(l);
    pack_.frames.set(l, mesh_.point(v), Frame(normal[v]));
    pack_.depth[l] = depth_[at + l];
  }
  if (lanes == 0) return;
  const std::size_t points = walker_.vertices(GroupWalker::kMaxRings).size();
  std::size_t size = 0;
  for (std::size_t i = 0; i < points; ++i) {
    const std::uint32_t use = static_cast<std::uint32_t>(masks_[i] >> at) & 0xffu;
    entries_[size] = {static_cast<std::uint32_t>(i), use};
    size += use != 0;
  }
  fit_ring_lanes(instruction_set(), pack_.frames, points_, std::span(entries_).first(size), terms, options, pack_.fits);
}

}  // namespace intarsia::kernels
