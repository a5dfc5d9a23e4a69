#include "kernels/scale/disc_samples.h"

#include <algorithm>
#include <bit>

#include "engine/base/lanes.h"

namespace intarsia::kernels {

namespace {

constexpr Real kBelow = 1.15;       // points below a cluster lie hardly further than that from its centre, in its cells
constexpr std::size_t kShared = 2;  // finer levels share lists below a cluster of this one, of about 64 vertices

// Where the packs of a list are.
struct Middles {
  const float *x, *y, *z, *reach;
  const std::int32_t* chord;
};

// inside[p] = 1 where pack p may have a sample within `limit` of the point. Returns the largest chord of those.
INTARSIA_WIDE std::int32_t find_inside(std::size_t packs, const Middles& of, float x, float y, float z, float limit,
                                       std::int32_t* inside) {
  std::int32_t most_chord = 0;
  for (std::size_t p = 0; p < packs; ++p) {
    const float dx = of.x[p] - x, dy = of.y[p] - y, dz = of.z[p] - z, most = limit + of.reach[p];
    inside[p] = dx * dx + dy * dy + dz * dz <= most * most;
    const std::int32_t chord = of.chord[p] & -inside[p];
    most_chord = chord > most_chord ? chord : most_chord;
  }
  return most_chord;
}

// Floats that are not negative are ordered as their bits.
std::int32_t ordered_bits(float x) { return std::bit_cast<std::int32_t>(x); }

}  // namespace

DiscSamples::DiscSamples(const LevelBuild& build) : build_(build), list_(build.tiles.size()) {
  for (int d = 0; d < kDiscs; ++d) radius_[static_cast<std::size_t>(d)] = disc_radius(kFirstDisc + d);
  for (std::size_t l = 0; l < list_.size(); ++l) list_[l].stamp.assign(build.tiles[l].tile.size(), 0);
}

DiscSamples::View DiscSamples::around(Index c, int code, const Vec3& at, float flat) {
  const SampleLevels& levels = build_.levels;
  const Real radius = radius_[static_cast<std::size_t>(code - kFirstDisc)], spacing = levels.level[0].spacing[c];
  const std::size_t level = levels.level_for(radius, spacing);
  const std::size_t shared_level = std::min(std::max(level + 1, kShared), levels.level.size() - 1);
  Index shared = c;
  for (std::size_t l = 1; l <= shared_level; ++l) shared = levels.level[l].parent[shared];
  List& list = list_[level];
  if (list.shared != shared || list.code != code) walk(list, level, shared, shared_level, code);

  const Real cell = std::max(SampleLevels::cell(level, spacing), Real(1e-12));
  const float limit = static_cast<float>((radius + 0.5 * cell) * 1.00001);
  const Vec3 from = at - list.origin;
  const float x = static_cast<float>(from.x()), y = static_cast<float>(from.y()), z = static_cast<float>(from.z());
  const std::size_t packs = list.packs;
  if (picked_.size() < packs + 2) picked_.resize(2 * packs + 2), inside_.resize(2 * packs + 2);
  const Middles middles{list.x.data(), list.y.data(), list.z.data(), list.reach.data(), list.chord.data()};
  const std::int32_t chord = find_inside(packs, middles, x, y, z, limit, inside_.data());
  if (chord < ordered_bits(flat)) return {picked_.data(), 0, radius, cell};
  std::size_t size = 0;
  for (std::size_t p = 0; p < packs; ++p) {  // without a branch: inside or not is hard to predict
    const Picked& pack = list.pack[p];
    picked_[size] = {pack.pack, x - pack.x, y - pack.y, z - pack.z};
    size += static_cast<std::size_t>(inside_[p]);
  }
  picked_[size] = {&nothing_, 0, 0, 0};
  return {picked_.data(), size + size % 2, radius, cell};
}

void DiscSamples::walk(List& list, std::size_t l, Index shared, std::size_t shared_level, int code) {
  const SampleLevels& levels = build_.levels;
  const SampleTiles& tiles = build_.tiles[l];
  const SampleLevel &above = levels.level[shared_level], &level = levels.level[tiles.level];
  list.shared = shared, list.code = code;
  if (++list.walk == 0) {
    std::fill(list.stamp.begin(), list.stamp.end(), 0u);
    list.walk = 1;
  }
  Index first = shared;
  for (std::size_t k = shared_level; k < tiles.level; ++k) first = levels.level[k + 1].parent[first];
  for (std::size_t k = shared_level; k > tiles.level; --k) first = levels.level[k].member.row(first)[0];
  const Real spacing = above.spacing[shared];
  // Discs are centred below the ancestor; the ramp adds half a cell.
  const Real reach = radius_[static_cast<std::size_t>(code - kFirstDisc)] +
                     kBelow * SampleLevels::cell(shared_level, spacing) + 0.5 * SampleLevels::cell(l, spacing);
  const Vec3 from = above.centre[shared];
  list.tile.assign(1, first);
  list.stamp[first] = list.walk;
  for (std::size_t i = 0; i < list.tile.size(); ++i)
    for (const Index t : level.neighbours.row(list.tile[i])) {
      if (list.stamp[t] == list.walk) continue;
      list.stamp[t] = list.walk;
      const Real most = reach + Real{tiles.tile[t].reach};
      if ((level.centre[t] - from).squaredNorm() <= most * most) list.tile.push_back(t);
    }
  list.origin = from;
  fill(list, tiles);
}

void DiscSamples::fill(List& list, const SampleTiles& tiles) {
  const Vec3Array& centre = build_.levels.level[tiles.level].centre;
  std::size_t packs = 0;
  for (const Index t : list.tile) packs += tiles.offset[t + 1] - tiles.offset[t];
  if (list.x.size() < packs) {
    for (std::vector<float>* a : {&list.x, &list.y, &list.z, &list.reach}) a->resize(2 * packs);
    list.chord.resize(2 * packs), list.pack.resize(2 * packs);
  }
  list.packs = packs;
  const float* axis = tiles.tile[list.tile[0]].axis;
  std::size_t i = 0;
  for (const Index t : list.tile) {
    const SampleTiles::Tile& tile = tiles.tile[t];
    const std::int32_t chord = ordered_bits(chord_between(tile.axis, axis) + tile.chord);
    const Vec3 from = centre[t] - list.origin;
    const float x = static_cast<float>(from.x()), y = static_cast<float>(from.y()), z = static_cast<float>(from.z());
    for (Index p = tiles.offset[t]; p < tiles.offset[t + 1]; ++p, ++i) {
      const SampleTiles::Pack& pack = tiles.pack[p];
      list.x[i] = x + pack.middle[0], list.y[i] = y + pack.middle[1], list.z[i] = z + pack.middle[2];
      list.reach[i] = pack.reach, list.chord[i] = chord;
      list.pack[i] = {&pack, x, y, z};
    }
  }
}

}  // namespace intarsia::kernels
