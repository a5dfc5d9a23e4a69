#include "kernels/scale/sample_tiles.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/for_each.h"
#include "engine/parallel/scan.h"

namespace intarsia::kernels {

namespace {

constexpr std::size_t kLevelsAbove = 2;  // about 16 samples a tile
constexpr std::size_t kPack = SampleTiles::kPack;
constexpr float kRounding = 1.00001f;

// The clusters of level `to` below cluster c of level `from`.
void collect(const SampleLevels& levels, std::size_t from, Index c, std::size_t to, std::vector<Index>& out) {
  if (from == to) {
    out.push_back(c);
    return;
  }
  for (const Index i : levels.level[from].member.row(c)) collect(levels, from - 1, i, to, out);
}

Index count(const SampleLevels& levels, std::size_t from, Index c, std::size_t to) {
  if (from == to) return 1;
  const auto row = levels.level[from].member.row(c);
  if (from == to + 1) return static_cast<Index>(row.size());
  Index sum = 0;
  for (const Index i : row) sum += count(levels, from - 1, i, to);
  return sum;
}

struct Cone {
  float axis[3], chord;
};

// Mean normal and the root mean square of the chords from it: the sum of A |n - axis|^2 is 2 (sum of A - |sum of A n|).
Cone cone_of(const Vec3& normal, Real area) {
  const Real length = normal.norm();
  const Vec3 axis = length > 0 ? Vec3(normal / length) : Vec3(Vec3::UnitZ());
  Cone cone;
  for (int i = 0; i < 3; ++i) cone.axis[i] = static_cast<float>(axis[i]);
  // Faces are in single precision: a millionth of the area may be rounding.
  cone.chord = area > 0 ? static_cast<float>(std::sqrt(std::max(2 * (1 - length / area), Real(0)) + 1e-6)) : 0.0f;
  return cone;
}

void fill(SampleTiles::Pack& pack, const SampleLevel& level, const std::vector<Tensor>& tensor, const Vec3& origin,
          std::span<const Index> sample) {
  for (auto& v : pack.value) std::fill(std::begin(v), std::end(v), 0.0f);
  Vec3 middle = Vec3::Zero();
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const Vec3 at = level.centre[sample[i]] - origin;
    middle += at;
    for (int j = 0; j < 3; ++j) pack.value[j][i] = static_cast<float>(at[j]);
    for (std::size_t j = 0; j < 6; ++j) pack.value[3 + j][i] = static_cast<float>(tensor[sample[i]][j]);
  }
  for (int j = 0; j < 3; ++j) pack.middle[j] = static_cast<float>(middle[j] / static_cast<Real>(sample.size()));
  float most = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const float at[3] = {pack.value[0][i], pack.value[1][i], pack.value[2][i]};
    most = std::max(most, chord_between(at, pack.middle));
  }
  pack.reach = most * kRounding;
}

}  // namespace

SampleTiles sample_tiles(const Work& work, const SampleLevels& levels, std::span<const SampleSums> sums,
                         std::size_t l) {
  SampleTiles out;
  out.level = std::min(l + kLevelsAbove, levels.level.size() - 1);
  const SampleLevel &level = levels.level[l], &above = levels.level[out.level];
  const std::size_t tiles = above.size();
  out.offset.assign(tiles + 1, 0);
  for_each(work, Cost::light, tiles, [&](std::size_t t) {
    out.offset[t] = (count(levels, out.level, static_cast<Index>(t), l) + kPack - 1) / kPack;
  });
  out.pack.resize(exclusive_scan<Index>(work, out.offset));
  out.tile.resize(tiles);
  for_each_block(work, Cost::light, tiles, [&](std::size_t begin, std::size_t end, std::size_t) {
    std::vector<Index> sample;
    for (std::size_t t = begin; t < end; ++t) {
      sample.clear();
      collect(levels, out.level, static_cast<Index>(t), l, sample);
      const Vec3 centre = above.centre[t];
      const Cone cone = cone_of(sums[out.level].normal[t], above.area[t]);
      SampleTiles::Tile& tile = out.tile[t];
      std::copy_n(cone.axis, 3, tile.axis);
      tile.chord = tile.reach = 0;
      for (const Index s : sample) {
        const Cone own = cone_of(sums[l].normal[s], level.area[s]);
        if (level.area[s] > 0) tile.chord = std::max(tile.chord, chord_between(own.axis, cone.axis) + own.chord);
        tile.reach = std::max(tile.reach, static_cast<float>((level.centre[s] - centre).norm()) * kRounding);
      }
      for (std::size_t i = 0; i < sample.size(); i += kPack)
        fill(out.pack[out.offset[t] + i / kPack], level, sums[l].tensor, centre,
             std::span(sample).subspan(i, std::min(kPack, sample.size() - i)));
    }
  });
  return out;
}

float flat_chord(Real variation) {
  const Real v = 0.99 * std::max(variation, Real(0));
  return static_cast<float>(std::sqrt(v / (1 + v)));
}

}  // namespace intarsia::kernels
