// The samples of discs around neighbouring clusters, in packs of eight: every cluster below a common ancestor has the
// same list, and larger discs of one level go on where smaller ones ended.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/data/sample_levels.h"
#include "kernels/scale/sample_levels.h"

namespace intarsia::kernels {

// One per thread at a time. It keeps 4 bytes per cluster.
class DiscSamples {
 public:
  static constexpr std::size_t kPack = 8, kValues = 9;
  struct alignas(32) Pack {
    float value[kValues][kPack];  // x, y, z, relative to the origin, xx, xy, xz, yy, yz, zz of eight samples
  };
  struct View {
    const Pack* pack;
    std::size_t packs;  // even; filled up with what votes for nothing
    Vec3 origin;
    Real radius, cell;  // of the disc; distance between samples
  };

  // The build must outlive this.
  explicit DiscSamples(const LevelBuild& build);

  // Samples for the disc `code` around the points of cluster c of level 0: a superset, to be weighed by ramp(). Which
  // they are, and their order, depends on the ancestor and the code only. Valid until the next call.
  // Requires: is_disc(code).
  View around(Index c, int code);

 private:
  // Clusters of one level that are connected to the first inside a ball around an ancestor; the ball grows by stages,
  // one for each code from `first_code` on.
  struct List {
    Index shared = kNone;  // the ancestor
    int first_code = 0, stages = 0;
    Vec3 centre;      // of the balls
    Real margin = 0;  // by which the radii of the balls exceed those of the discs
    std::uint32_t walk = 0;
    std::vector<std::uint32_t> stamp;  // per cluster: the walk that met it last
    std::vector<Index> id;             // longer than what is in use
    std::size_t size = 0, expanded = 0, packed = 0, packs = 0;
    struct Miss {
      Index id;
      Real squared;
    };
    std::vector<Miss> miss;  // met outside the ball; longer than what is in use
    std::size_t misses = 0;
    std::array<std::size_t, kDiscs> stage_end{};  // in packs
    std::vector<Pack> pack;
  };

  void start(List& list, std::size_t level, Index shared, std::size_t shared_level);
  void grow(List& list, std::size_t level, Real radius);
  void take(List& list, const SampleLevel& level, const Index* begin, const Index* end, Real most);
  void fill_packs(List& list, std::size_t level);

  const LevelBuild& build_;
  std::array<Real, kDiscs> radius_{};
  std::vector<List> list_;    // per level
  std::vector<Index> fresh_;  // longer than what is in use
};

}  // namespace intarsia::kernels
