// Fits over rings for a group of up to 64 neighbouring vertices: one walk over all that any of them reaches, then packs
// of eight vertices in lanes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/group_walk.h"
#include "engine/data/k_ring.h"
#include "kernels/curvature/cubic_lanes.h"

namespace intarsia::kernels {

// Whether a vertex has a normal to stand on.
inline bool has_normal(const Vec3& n) { return n.squaredNorm() > 0.5; }

// One fitter serves one thread at a time.
class GroupFitter {
 public:
  static constexpr Index kGroup = GroupWalker::kGroup;

  // Eight consecutive vertices. Only lanes in `active` were asked for; those of them that are not in fits.solved want
  // the fit of one vertex (fit_cubic.h), which grows, cuts and lowers what has no plain answer.
  struct Pack {
    Index first = 0;
    std::uint32_t active = 0;
    LaneFrames frames;
    LaneFits fits;
    std::array<std::uint8_t, kLanes> depth{};  // last ring that has points, at most the one asked for
  };

  // Mesh and barrier as in engine/data/group_walk.h.
  GroupFitter(const MeshView& mesh, std::span<const std::uint8_t> barrier) : mesh_(mesh), walker_(mesh, barrier) {}

  // Fits vertices first .. first + ring.size() - 1, each over its own number of rings (0: not at all) in the frame of
  // its normal, and calls take(pack) for every pack with an active lane, in order. The points of a lane come in the
  // order of the walk of its group: groups start at multiples of kGroup, so that results depend on the mesh alone.
  // Requires: at most kGroup rings of at most kRings; first a multiple of kGroup; terms is 7 or 9.
  template <class Take>
  void fit(Index first, std::span<const std::uint8_t> ring, const Vec3View& normal, std::size_t terms,
           const FitOptions& options, const Take& take) {
    gather(first, ring, normal);
    for (std::size_t at = 0; at < ring.size(); at += kLanes) {
      pack_.first = first + static_cast<Index>(at);
      pack_.active = static_cast<std::uint32_t>(active_ >> at) & 0xffu;
      if (pack_.active == 0) continue;
      fit_pack(at, normal, terms, options);
      take(pack_);
    }
  }

 private:
  using Mask = GroupWalker::Mask;

  void gather(Index first, std::span<const std::uint8_t> ring, const Vec3View& normal);
  void find_depths(int rings);
  void fit_pack(std::size_t at, const Vec3View& normal, std::size_t terms, const FitOptions& options);

  MeshView mesh_;
  GroupWalker walker_;
  Mask active_ = 0;  // vertices of the group to be fitted
  Mask walked_ = 0;  // those of them whose walk can be used
  std::array<std::uint8_t, kGroup> depth_{};
  std::vector<LanePoint> points_;
  std::vector<Mask> masks_;  // per point: the vertices of the group that use it
  std::vector<LaneEntry> entries_;
  Pack pack_;
};

}  // namespace intarsia::kernels
