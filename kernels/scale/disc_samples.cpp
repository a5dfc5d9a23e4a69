#include "kernels/scale/disc_samples.h"

#include <algorithm>

namespace intarsia::kernels {

namespace {

constexpr Real kBelow = 1.15;       // points below a cluster lie hardly further than that from its centre, in its cells
constexpr std::size_t kShared = 2;  // finer levels share lists below a cluster of this one, of about 64 vertices

template <class T>
void make_room(std::vector<T>& list, std::size_t size) {
  if (list.size() < size) list.resize(2 * size);
}

}  // namespace

DiscSamples::DiscSamples(const LevelBuild& build) : build_(build), list_(build.levels.level.size()) {
  for (int d = 0; d < kDiscs; ++d) radius_[static_cast<std::size_t>(d)] = disc_radius(kFirstDisc + d);
  for (std::size_t l = 0; l < list_.size(); ++l) list_[l].stamp.assign(build.levels.level[l].size(), 0);
}

DiscSamples::View DiscSamples::around(Index c, int code) {
  const SampleLevels& levels = build_.levels;
  const Real radius = radius_[static_cast<std::size_t>(code - kFirstDisc)], spacing = levels.level[0].spacing[c];
  const std::size_t level = levels.level_for(radius, spacing);
  const std::size_t shared_level = std::min(std::max(level + 1, kShared), levels.level.size() - 1);
  Index shared = c;
  for (std::size_t l = 1; l <= shared_level; ++l) shared = levels.level[l].parent[shared];
  List& list = list_[level];
  if (list.shared != shared) start(list, level, shared, shared_level);
  const int stage = std::max(code - list.first_code, 0);
  for (; list.stages <= stage; ++list.stages) {
    grow(list, level, radius_[static_cast<std::size_t>(list.first_code + list.stages - kFirstDisc)]);
    list.stage_end[static_cast<std::size_t>(list.stages)] = list.packs;
  }
  return {list.pack.data(), list.stage_end[static_cast<std::size_t>(stage)], list.centre, radius,
          std::max(SampleLevels::cell(level, spacing), Real(1e-12))};
}

void DiscSamples::start(List& list, std::size_t level, Index shared, std::size_t shared_level) {
  const SampleLevel& above = build_.levels.level[shared_level];
  const Real spacing = above.spacing[shared];
  list.shared = shared;
  list.centre = above.centre[shared];
  // The ramp adds half a cell.
  list.margin = kBelow * SampleLevels::cell(shared_level, spacing) + 0.5 * SampleLevels::cell(level, spacing);
  // Hardly a cluster asks this level for a smaller disc; those that do get the samples of this one.
  list.first_code = kFirstDisc;
  while (list.first_code < kLastDisc && radius_[static_cast<std::size_t>(list.first_code + 1 - kFirstDisc)] <=
                                            0.7 * 3.2 * SampleLevels::cell(level, spacing))
    ++list.first_code;
  if (++list.walk == 0) {
    std::fill(list.stamp.begin(), list.stamp.end(), 0u);
    list.walk = 1;
  }
  Index first = shared;
  for (std::size_t l = shared_level; l > level; --l) first = build_.levels.level[l].member.row(first)[0];
  make_room(list.id, 1);
  list.id[0] = first;
  list.stamp[first] = list.walk;
  list.size = 1;
  list.expanded = list.packed = list.packs = list.misses = 0;
  list.stages = 0;
}

// Clusters that were just met go to the list or to the misses.
void DiscSamples::take(List& list, const SampleLevel& level, const Index* begin, const Index* end, Real most) {
  const std::size_t count = static_cast<std::size_t>(end - begin);
  make_room(list.id, list.size + count + 1), make_room(list.miss, list.misses + count + 1);
  Index* id = list.id.data() + list.size;
  List::Miss* miss = list.miss.data() + list.misses;
  for (; begin != end; ++begin) {  // without a branch: inside or not is hard to predict
    const Real squared = (level.centre[*begin] - list.centre).squaredNorm();
    const bool inside = squared <= most;
    *id = *begin;
    *miss = {*begin, squared};
    id += inside, miss += !inside;
  }
  list.size = static_cast<std::size_t>(id - list.id.data());
  list.misses = static_cast<std::size_t>(miss - list.miss.data());
}

// Adds what is connected inside the ball of the disc's radius.
void DiscSamples::grow(List& list, std::size_t l, Real radius) {
  constexpr std::size_t kRow = 8;
  const SampleLevel& level = build_.levels.level[l];
  const Real reach = radius + list.margin, most = reach * reach;
  make_room(list.id, list.size + list.misses + 1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < list.misses; ++i) {
    const List::Miss m = list.miss[i];
    const bool inside = m.squared <= most;
    list.id[list.size] = m.id;
    list.miss[kept] = m;
    list.size += inside, kept += !inside;
  }
  list.misses = kept;
  const Index* offset = level.neighbours.offset.data();
  const Index* item = level.neighbours.item.data();
  std::uint32_t* stamp = list.stamp.data();
  const std::uint32_t walk = list.walk;
  while (list.expanded < list.size) {
    const std::size_t end = list.size;
    std::size_t fresh = 0;
    for (; list.expanded < end; ++list.expanded) {
      const Index c = list.id[list.expanded], valence = offset[c + 1] - offset[c];
      if (valence == 0) continue;
      const Index* row = item + offset[c];
      make_room(fresh_, fresh + valence + kRow);
      Index* out = fresh_.data();
      const auto meet = [&](Index w) {
        const bool is_new = stamp[w] != walk;
        stamp[w] = walk;
        out[fresh] = w;
        fresh += is_new;
      };
      for (Index j = 0; j < kRow; ++j) meet(row[std::min(j, valence - 1)]);
      for (Index j = kRow; j < valence; ++j) meet(row[j]);
    }
    take(list, level, fresh_.data(), fresh_.data() + fresh, most);
  }
  fill_packs(list, l);
}

// Whole pairs of packs a stage, so that a smaller disc never sees what a larger one has added.
void DiscSamples::fill_packs(List& list, std::size_t l) {
  const SampleLevel& level = build_.levels.level[l];
  const auto& tensor = build_.tensor[l];
  const std::size_t count = list.size - list.packed, packs = (count + 2 * kPack - 1) / (2 * kPack) * 2;
  make_room(list.pack, list.packs + packs);
  Pack* pack = list.pack.data() + list.packs;
  for (std::size_t i = 0; i < count; ++i) {
    const Index c = list.id[list.packed + i];
    float* v = &pack[i / kPack].value[0][i % kPack];
    v[0] = static_cast<float>(level.centre.x[c] - list.centre.x());
    v[kPack] = static_cast<float>(level.centre.y[c] - list.centre.y());
    v[2 * kPack] = static_cast<float>(level.centre.z[c] - list.centre.z());
    for (std::size_t j = 0; j < 6; ++j) v[(3 + j) * kPack] = static_cast<float>(tensor[c][j]);
  }
  for (std::size_t i = count; i < packs * kPack; ++i)
    for (std::size_t j = 0; j < kValues; ++j) pack[i / kPack].value[j][i % kPack] = 0;
  list.packed = list.size;
  list.packs += packs;
}

}  // namespace intarsia::kernels
