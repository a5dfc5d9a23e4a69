#include "tools/picture/palette.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/hash.h"
#include "engine/parallel/compact.h"
#include "engine/parallel/sort.h"

namespace intarsia::tools {
namespace {

using Lab = Eigen::Vector3f;  // OKLab: lightness, two opponent axes

struct Swatch {
  Rgb rgb;
  Lab lab;
};

float to_linear(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }
float to_display(float v) { return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f; }

Rgb rgb_of(const Lab& c) {
  const float l = std::pow(c[0] + 0.3963377774f * c[1] + 0.2158037573f * c[2], 3.0f);
  const float m = std::pow(c[0] - 0.1055613458f * c[1] - 0.0638541728f * c[2], 3.0f);
  const float s = std::pow(c[0] - 0.0894841775f * c[1] - 1.2914855480f * c[2], 3.0f);
  const auto byte = [](float v) {
    return static_cast<std::uint8_t>(255 * std::clamp(to_display(std::max(0.0f, v)), 0.0f, 1.0f) + 0.5f);
  };
  return {byte(4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s),
          byte(-1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s),
          byte(-0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s)};
}

Lab lab_of(Rgb c) {
  const float r = to_linear(static_cast<float>(c.r) / 255), g = to_linear(static_cast<float>(c.g) / 255),
              b = to_linear(static_cast<float>(c.b) / 255);
  const float l = std::cbrt(0.4122214708f * r + 0.5363325363f * g + 0.0514459929f * b);
  const float m = std::cbrt(0.2119034982f * r + 0.6806995451f * g + 0.1073969566f * b);
  const float s = std::cbrt(0.0883024619f * r + 0.2817188376f * g + 0.6299787005f * b);
  return {0.2104542553f * l + 0.7936177850f * m - 0.0040720468f * s,
          1.9779984951f * l - 2.4285922050f * m + 0.4505937099f * s,
          0.0259040371f * l + 0.7827717662f * m - 0.8086757660f * s};
}

Swatch swatch(float lightness, float chroma, float degrees) {
  const float hue = degrees * 0.017453292519943295f;
  const Rgb rgb = rgb_of({lightness, chroma * std::cos(hue), chroma * std::sin(hue)});
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
