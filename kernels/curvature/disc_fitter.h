// Fits in discs of coarse samples for the vertices below one cluster, packs of eight in lanes: neighbours with the same
// scale share their samples.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/disc_walk.h"
#include "engine/data/sample_levels.h"
#include "kernels/curvature/cubic_lanes.h"

namespace intarsia::kernels {

// One fitter serves one thread at a time.
class DiscFitter {
 public:
  struct Pack {
    std::size_t size = 0;
    int code = 0;
    std::array<Index, kLanes> vertex{}, cluster{};  // clusters of level 0
    LaneFrames frames;
    LaneFits fits;  // the gradient is to be taken as 0, see fit_disc
  };

  // The level whose clusters are handed to fit(): its clusters hold about 64 vertices.
  static std::size_t start_level(const SampleLevels& levels) {
    return std::min<std::size_t>(levels.level.size() - 1, 2);
  }

  // All must outlive the fitter. Sample normals: one unit mean normal per cluster of every level (fit_cubic.h).
  DiscFitter(const MeshView& mesh, const SampleLevels& levels, std::span<const Vec3Array> sample_normal)
      : mesh_(mesh), levels_(levels), sample_normal_(sample_normal), walker_(levels) {}

  // Fits the vertices below cluster `c` of the start level whose scale is a disc, and calls take(pack) for every pack.
  // Lanes below pack.size that are not in fits.solved want the fit of one vertex. The points of a lane come in the
  // order of the walk that its cluster's list was made by, whatever pack it is in.
  template <class Take>
  void fit(Index c, const Vec3View& normal, std::span<const std::uint8_t> fit_ring, const FitOptions& options,
           const Take& take) {
    collect(c, fit_ring);
    for (int code = kFirstDisc; code <= kLastDisc; ++code) {
      if ((codes_ >> code & 1) == 0) continue;
      std::size_t next = 0;
      while (next_pack(code, next, normal, options)) take(pack_);
    }
  }

 private:
  struct Item {
    Index vertex, cluster;
    int code;
  };
  // The samples of the last list asked for, side by side.
  struct Gathered {
    DiscWalker::Place place;
    std::vector<LanePoint> points;
    LaneArray x, y, z;
  };

  void collect(Index c, std::span<const std::uint8_t> fit_ring);
  void collect_below(std::size_t level, Index c, std::span<const std::uint8_t> fit_ring);
  bool next_pack(int code, std::size_t& next, const Vec3View& normal, const FitOptions& options);
  const Gathered& samples_of(const DiscWalker::Place& place, Index cluster, int code);
  void fit_pack(const Gathered& samples, const FitOptions& options);

  MeshView mesh_;
  const SampleLevels& levels_;
  std::span<const Vec3Array> sample_normal_;
  DiscWalker walker_;
  std::array<Gathered, kDiscs> gathered_;
  std::vector<Item> items_;
  std::uint32_t codes_ = 0;  // those that items have
  std::vector<LaneEntry> entries_;
  LaneArray squared_;
  LaneDiscs discs_;
  Pack pack_;
};

}  // namespace intarsia::kernels
