// The samples of discs around neighbouring clusters, in packs of eight: clusters below a common ancestor share the list
// of tiles that are connected near it, and every disc picks the packs that it reaches.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/data/sample_levels.h"
#include "kernels/scale/sample_levels.h"

namespace intarsia::kernels {

// One per thread at a time. It keeps 4 bytes per tile.
class DiscSamples {
 public:
  struct Picked {
    const SampleTiles::Pack* pack;
    float x, y, z;  // the disc's centre, relative to the pack's tile
  };
  struct View {
    const Picked* picked;
    std::size_t packs;  // even; filled up with what votes for nothing
    Real radius, cell;  // of the disc; distance between samples
  };

  // The build must outlive this.
  explicit DiscSamples(const LevelBuild& build);

  // Samples for the disc `code` around point `at` near cluster c of level 0: a superset, to be weighed by ramp(). Which
  // count, and their order, depends on the ancestor, the code and the point only. None where the chord of all normals
  // below the tiles it reaches from one axis (see SampleTiles) is less than `flat`. Valid until the next call.
  // Requires: is_disc(code); flat >= 0.
  View around(Index c, int code, const Vec3& at, float flat = 0);

 private:
  // Tiles that are connected to the ancestor's inside a ball around it.
  struct List {
    Index shared = kNone;  // the ancestor
    int code = 0;
    std::uint32_t walk = 0;
    std::vector<std::uint32_t> stamp;  // per tile: the walk that met it last
    std::vector<Index> tile;
    // Their packs, side by side; positions are relative to the ancestor's centre.
    Vec3 origin;
    std::size_t packs = 0;
    std::vector<float> x, y, z, reach;  // the middle of the eight, and how far they are from it
    std::vector<std::int32_t> chord;    // bits of a float: of the tile's normals from the axis of the first tile
    std::vector<Picked> pack;           // with the tile's centre
  };

  void fill(List& list, const SampleTiles& tiles);
  void walk(List& list, std::size_t level, Index shared, std::size_t shared_level, int code);

  const LevelBuild& build_;
  std::array<Real, kDiscs> radius_{};
  std::vector<List> list_;  // per level of samples
  std::vector<Picked> picked_;
  std::vector<std::int32_t> inside_;
  SampleTiles::Pack nothing_{};
};

}  // namespace intarsia::kernels
