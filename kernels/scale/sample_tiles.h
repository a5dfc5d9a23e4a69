// The samples of a level as the loops over discs want them: in packs of eight, a few packs a tile. A tile is a cluster
// some levels above; its samples lie close together, so a disc takes or leaves whole packs.
//
// Every tile also says how far the normals below it lie from its mean normal. With all normals of a disc at most a
// chord r = |n - axis| from one axis, the largest eigenvalue of its tensor is at least 1 - r^2 of the trace whatever
// the weights, so (l2 + l3) / l1 <= r^2 / (1 - r^2). It is enough that the root mean square of the chords inside of
// every sample is below r: the bound is a mean over them. Root mean squares add up like distances.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/data/sample_levels.h"
#include "engine/parallel/work.h"
#include "kernels/scale/voting_tensor.h"

namespace intarsia::kernels {

struct SampleTiles {
  static constexpr std::size_t kPack = 8, kValues = 9;
  struct alignas(32) Pack {
    float value[kValues][kPack];  // x, y, z relative to the tile's centre, xx, xy, xz, yy, yz, zz of eight samples
    float middle[3];              // of the eight, relative too
    float reach;                  // no sample of the eight is further from there
  };
  struct Tile {
    float axis[3];  // mean normal, unit
    float chord;    // the largest of |axis of s - axis| + chord of s over its samples s
    float reach;    // no sample is further from the tile's centre
  };

  std::size_t level = 0;      // whose clusters are the tiles
  std::vector<Tile> tile;     // per cluster
  std::vector<Index> offset;  // per cluster: its first pack; one more at the end
  std::vector<Pack> pack;     // filled up with what votes for nothing
};

// Sums over the faces below every cluster of a level: A n n^T and A n.
struct SampleSums {
  std::vector<Tensor> tensor;
  Vec3Array normal;
};

// The tiles of the samples of level l.
SampleTiles sample_tiles(const Work& work, const SampleLevels& levels, std::span<const SampleSums> sums, std::size_t l);

// The largest chord of a tile for which variation is below `variation`, a little left for rounding.
float flat_chord(Real variation);

inline float chord_between(const float* a, const float* b) {
  const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

}  // namespace intarsia::kernels
