// Surface variation in discs for the clusters below one coarse cluster: neighbours share the list of samples, eight
// samples at a time. What disc_variation() computes for one cluster in double precision, in single precision.
#pragma once

#include <span>

#include "engine/base/instruction_set.h"
#include "engine/base/types.h"
#include "kernels/scale/disc_samples.h"

namespace intarsia::kernels {

// One per thread at a time.
class DiscVoting {
 public:
  // The build must outlive this. `set` is for tests: every set gives the same bits.
  explicit DiscVoting(const LevelBuild& build, InstructionSet set = instruction_set())
      : build_(build), set_(set), samples_(build) {}

  // From now on, discs whose variation is certainly below this get 0, and are not voted on. 0: none.
  void skip_below(Real variation) { skip_ = flat_chord(variation); }

  // variation[i] = that of clusters[i] (of level 0) in the disc `code` around centres[i]; without centres, around their
  // own. Fast where clusters that follow each other have a parent in common. Requires: as many of all; is_disc(code);
  // centres hardly outside of an ancestor that is not above the level of the disc's samples.
  void run(std::span<const Index> clusters, std::span<const Vec3> centres, int code, std::span<Real> variation);
  void run(std::span<const Index> clusters, int code, std::span<Real> variation) { run(clusters, {}, code, variation); }

 private:
  const LevelBuild& build_;
  InstructionSet set_;
  DiscSamples samples_;
  float skip_ = 0;  // chord
};

}  // namespace intarsia::kernels
