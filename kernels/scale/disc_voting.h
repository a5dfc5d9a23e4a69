// Surface variation in discs for the clusters below one coarse cluster: neighbours share the list of samples, eight
// samples at a time. What disc_variation() computes for one cluster in double precision, in single precision.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/instruction_set.h"
#include "engine/base/types.h"
#include "engine/data/disc_walk.h"
#include "kernels/scale/sample_levels.h"

namespace intarsia::kernels {

// One per thread at a time.
class DiscVoting {
 public:
  // The build must outlive this. `set` is for tests: every set gives the same bits.
  explicit DiscVoting(const LevelBuild& build, InstructionSet set = instruction_set())
      : build_(build), set_(set), walker_(build.levels) {}

  // variation[i] = that of clusters[i] (of level 0) in the disc `code`. Fast where clusters that follow each other have
  // a parent in common. Requires: as many of both; is_disc(code).
  void run(std::span<const Index> clusters, int code, std::span<Real> variation);

 private:
  struct alignas(32) Pack {
    float value[9][8];  // x, y, z, xx, xy, xz, yy, yz, zz of eight samples
  };
  // The samples of the last list asked for, relative to `origin`; whole packs of eight, filled up with what votes for
  // nothing.
  struct Gathered {
    DiscWalker::Place place;
    Vec3 origin;
    std::size_t size = 0;  // packs
    std::vector<Pack> pack;
  };
  const Gathered& samples_of(const DiscWalker::Place& place, Index cluster, int code);

  const LevelBuild& build_;
  InstructionSet set_;
  DiscWalker walker_;
  std::array<Gathered, kDiscs> gathered_;
};

}  // namespace intarsia::kernels
