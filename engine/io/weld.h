// Joins corners that lie at exactly the same place, for files that give every triangle its own points.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <utility>
#include <vector>

#include "engine/base/hash.h"
#include "engine/data/mesh.h"
#include "engine/parallel/for_each.h"
#include "engine/parallel/scan.h"

namespace intarsia {

// The same for equal positions; -0 equals 0.
inline std::uint64_t hash_of_place(const std::array<Real, 3>& p) {
  std::uint64_t bits = 0;
  for (const Real value : p)
    bits = (std::rotl(bits, 25) ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 0x9e3779b97f4a7c15ull;
  return mix64(bits);
}

// point(c) -> std::array<Real, 3>, for corners c in [0, corners). Fills soup.x, y, z and soup.corner: one vertex for
// each different position (-0 equals 0), in the order of first appearance.
// Requires: corners < kNone; all coordinates finite.
//
// Corners are dealt to buckets by a hash of their place, in order; each bucket then fits a cache and is searched by
// itself.
template <class Point>
void weld(const Work& work, Index corners, const Point& point, Soup& soup) {
  constexpr std::size_t kBlock = std::size_t{1} << 16, kBucket = std::size_t{1} << 14, kMostBuckets = 4096;
  const std::size_t buckets =
      std::clamp(std::bit_ceil(std::size_t{corners} / kBucket + 1), std::size_t{2}, kMostBuckets);
  const std::size_t blocks = (corners + kBlock - 1) / kBlock;
  const int shift = 32 - std::countr_zero(buckets);
  std::vector<std::uint32_t> hash(corners);       // the upper bits name the bucket
  std::vector<Index> place(blocks * buckets, 0);  // where the corners of a block go in each bucket
  for_each(work, Cost::single, blocks, [&](std::size_t b) {
    Index* count = place.data() + b * buckets;
    for (std::size_t c = b * kBlock; c < std::min<std::size_t>(corners, (b + 1) * kBlock); ++c) {
      hash[c] = static_cast<std::uint32_t>(hash_of_place(point(static_cast<Index>(c))) >> 32);
      ++count[hash[c] >> shift];
    }
  });
  std::vector<Index> begin(buckets + 1, 0);
  Index filled = 0;
  for (std::size_t k = 0; k < buckets; ++k) {
    begin[k] = filled;
    for (std::size_t b = 0; b < blocks; ++b) filled += std::exchange(place[b * buckets + k], filled);
  }
  begin[buckets] = filled;
  std::vector<Index> dealt(corners);  // corners by bucket, ascending in each
  for_each(work, Cost::single, blocks, [&](std::size_t b) {
    Index* to = place.data() + b * buckets;
    for (std::size_t c = b * kBlock; c < std::min<std::size_t>(corners, (b + 1) * kBlock); ++c)
      dealt[to[hash[c] >> shift]++] = static_cast<Index>(c);
  });

  // The first corner at a position stands for all of them.
  std::vector<Index>& corner = soup.corner;
  corner.resize(corners);
  for_each(work, Cost::single, buckets, [&](std::size_t k) {
    const std::size_t slots = std::bit_ceil(2 * std::size_t{begin[k + 1] - begin[k]} + 1);
    std::vector<Index> first(slots, kNone);
    for (Index i = begin[k]; i < begin[k + 1]; ++i) {
      const Index c = dealt[i];
      const auto p = point(c);
      std::size_t slot = hash[c] & (slots - 1);
      while (first[slot] != kNone && (hash[first[slot]] != hash[c] || point(first[slot]) != p))
        slot = (slot + 1) & (slots - 1);
      if (first[slot] == kNone) first[slot] = c;
      corner[c] = first[slot];
    }
  });
  std::vector<Index>& number = dealt;  // no longer needed as what it was
  for_each(work, Cost::light, corners, [&](std::size_t c) { number[c] = corner[c] == c ? 1 : 0; });
  const Index vertices = exclusive_scan<Index>(work, number);
  for (auto* a : {&soup.x, &soup.y, &soup.z}) a->resize(vertices);
  for_each(work, Cost::light, corners, [&](std::size_t c) {
    if (corner[c] == c) {
      const auto p = point(static_cast<Index>(c));
      soup.x[number[c]] = p[0], soup.y[number[c]] = p[1], soup.z[number[c]] = p[2];
    }
  });
  for_each(work, Cost::light, corners, [&](std::size_t c) { corner[c] = number[corner[c]]; });
}

}  // namespace intarsia
