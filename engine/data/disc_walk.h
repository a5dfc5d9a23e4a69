// The samples of a disc: clusters of one level, connected to a start inside a ball.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/sample_levels.h"

namespace intarsia {

// One walker serves one thread at a time. It keeps 4 bytes per cluster.
class DiscWalker {
 public:
  // The levels must outlive the walker.
  explicit DiscWalker(const SampleLevels& levels);

  // Where the samples for discs of one scale around the points of a cluster of level 0 come from.
  struct Place {
    std::size_t level = 0;  // of the samples
    Index shared = kNone;   // cluster that has the list, of the level above where there is one
    Real radius = 0, cell = 0;
    bool same_list(const Place& o) const { return level == o.level && shared == o.shared; }
  };
  // Requires: is_disc(code).
  Place place(Index c, int code) const;

  struct Samples {
    std::size_t level;          // which level they belong to
    std::span<const Index> id;  // breadth-first; a superset of the disc: weigh by ramp()
    Real cell;                  // distance between them
  };
  // Samples for discs of scale `code` around the points of cluster `c` of level 0. Clusters of one parent share
  // their samples, so walking the clusters in order is cheap: recent lists are kept. Spans live until the
  // next call with the same code. Requires: is_disc(code).
  Samples around(Index c, int code);

 private:
  static constexpr Index kKept = 64;  // neighbouring clusters have near numbers, not consecutive ones
  struct List {
    std::size_t level = 0;
    Index around = kNone;  // cluster that the list was made for, of the level above where there is one
    std::vector<Index> id;
  };
  void walk(List& list, Index first, const Vec3& centre, Real reach);

  const SampleLevels& levels_;
  std::vector<std::vector<std::uint32_t>> stamp_;
  std::uint32_t epoch_ = 0;
  std::vector<List> list_;  // kKept a code, by cluster
  std::array<Real, kDiscs> radius_{};
};

// Share of a sample at distance d in a disc: 1 inside, 0 outside, linear over one cell, so that neighbours see nearly
// the same disc.
inline Real ramp(Real d, Real radius, Real cell) {
  return std::clamp((radius - d) / cell + Real(0.5), Real(0), Real(1));
}

}  // namespace intarsia
