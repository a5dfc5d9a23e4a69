#include "tools/picture/palette.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/hash.h"
#include "engine/parallel/compact.h"
#include "engine/parallel/sort.h"
#include "tools/picture/oklab.h"

namespace intarsia::tools {
namespace {

struct Swatch {
  Rgb rgb;
  Lab lab;
};

Swatch swatch(float lightness, float chroma, float degrees) {
  const Rgb rgb = rgb_of(lab_at(lightness, chroma, degrees));
  return {rgb, lab_of(rgb)};
}

// Twelve hues on a lighter and on a deeper level, half a step apart; red and blue stay pale beside the line colours.
std::vector<Swatch> swatches() {
  std::vector<Swatch> set;
  for (int i = 0; i < 12; ++i) {
    set.push_back(swatch(0.865f, 0.085f, 30.0f * static_cast<float>(i) + 20));
    set.push_back(swatch(0.750f, 0.105f, 30.0f * static_cast<float>(i) + 35));
  }
  return set;
}

// A colour outside the fixed set, for the rare patch whose neighbours use all of it.
Swatch spare(Index patch, std::uint64_t attempt) {
  const std::uint64_t h = mix64(mix64(patch) + attempt);
  const auto part = [h](int shift) { return static_cast<float>(h >> shift & 1023) / 1023; };
  return swatch(0.66f + 0.24f * part(0), 0.04f + 0.08f * part(10), 360 * part(20));
}

}  // namespace

Csr adjacent_patches(const Work& work, const MeshView& mesh, std::span<const Index> patch_of_face, Index patches) {
  const auto labels = [&](std::size_t e) {
    const Index f1 = mesh.edge_f1[e];
    return std::pair{patch_of_face[mesh.edge_f0[e]], f1 == kNone ? kNone : patch_of_face[f1]};
  };
  const std::vector<Index> border = compact(work, mesh.edge_count(), [&](std::size_t e) {
    const auto [a, b] = labels(e);
    return a != b && a != kNone && b != kNone;
  });
  std::vector<std::uint64_t> pair(2 * border.size());
  for_each(work, Cost::light, border.size(), [&](std::size_t i) {
    const auto [a, b] = labels(border[i]);
    pair[2 * i] = std::uint64_t{a} << 32 | b, pair[2 * i + 1] = std::uint64_t{b} << 32 | a;
  });
  sort_total(work, pair.begin(), pair.end());
  pair.erase(std::unique(pair.begin(), pair.end()), pair.end());
  Csr adjacency;
  adjacency.offset.assign(std::size_t{patches} + 1, 0);
  adjacency.item.reserve(pair.size());
  for (std::uint64_t p : pair) ++adjacency.offset[(p >> 32) + 1], adjacency.item.push_back(static_cast<Index>(p));
  std::partial_sum(adjacency.offset.begin(), adjacency.offset.end(), adjacency.offset.begin());
  return adjacency;
}

std::vector<Rgb> patch_colours(const Work& work, CsrView adjacency) {
  const Index patches = adjacency.rows();
  const std::vector<Swatch> set = swatches();
  std::vector<Index> order(patches);
  std::iota(order.begin(), order.end(), Index{0});
  sort_total(work, order.begin(), order.end(), [&](Index a, Index b) {
    const std::size_t da = adjacency.row(a).size(), db = adjacency.row(b).size();
    return da != db ? da > db : a < b;
  });

  std::vector<Swatch> colour(patches);
  std::vector<std::uint8_t> done(patches, 0);
  std::vector<int> used(set.size(), 0);
  std::size_t visited = 0;
  for (Index p : order) {
    if (++visited % 256 == 0) work.check();
    std::vector<float> near(set.size(), 0.30f), around(set.size(), 0.20f);  // distances beyond these count as equal
    std::size_t budget = 4096;  // a patch with thousands of second neighbours gains nothing from all of them
    for (Index q : adjacency.row(p)) {
      if (done[q])
        for (std::size_t k = 0; k < set.size(); ++k) near[k] = std::min(near[k], (set[k].lab - colour[q].lab).norm());
      for (Index r : adjacency.row(q)) {
        if (r == p || !done[r] || budget == 0) continue;
        --budget;
        for (std::size_t k = 0; k < set.size(); ++k)
          around[k] = std::min(around[k], (set[k].lab - colour[r].lab).norm());
      }
    }
    const float mean_use = static_cast<float>(visited) / static_cast<float>(set.size());
    std::size_t best = 0;
    float best_score = -1e9f;
    for (std::size_t k = 0; k < set.size(); ++k) {
      const float score = near[k] + 0.35f * around[k] - 0.05f * static_cast<float>(used[k]) / (1 + mean_use);
      if (score > best_score) best_score = score, best = k;
    }
    const auto taken = [&](Rgb rgb) {
      const auto row = adjacency.row(p);
      return std::any_of(row.begin(), row.end(), [&](Index q) { return done[q] && colour[q].rgb == rgb; });
    };
    colour[p] = set[best];
    for (std::uint64_t attempt = 0; taken(colour[p].rgb); ++attempt) colour[p] = spare(p, attempt);
    ++used[best], done[p] = 1;
  }
  std::vector<Rgb> result(patches);
  for (Index p = 0; p < patches; ++p) result[p] = colour[p].rgb;
  return result;
}

}  // namespace intarsia::tools
