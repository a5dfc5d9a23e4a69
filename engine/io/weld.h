// Joins corners that lie at exactly the same place, for files that give every triangle its own points.
#pragma once

#include <array>
#include <vector>

#include "engine/base/hash.h"
#include "engine/data/mesh.h"
#include "engine/parallel/for_each.h"
#include "engine/parallel/scan.h"
#include "engine/parallel/sort.h"

namespace intarsia {

// point(c) -> std::array<Real, 3>, for corners c in [0, corners). Fills soup.x, y, z and soup.corner: one vertex for
// each different position (-0 equals 0), in the order of first appearance.
// Requires: corners < kNone; all coordinates finite.
template <class Point>
void weld(const Work& work, Index corners, const Point& point, Soup& soup) {
  struct Key {
    std::uint64_t hash;
    Index corner;
  };
  std::vector<Key> key(corners);
  for_each(work, Cost::light, corners, [&](std::size_t c) {
    Hash hash;
    for (const Real value : point(static_cast<Index>(c))) hash.add(value);
    key[c] = {hash.value(), static_cast<Index>(c)};
  });
  sort_total(work, key.begin(), key.end(), [&](const Key& a, const Key& b) {
    if (a.hash != b.hash) return a.hash < b.hash;
    const auto p = point(a.corner), q = point(b.corner);
    return p != q ? p < q : a.corner < b.corner;
  });
  // The first corner of each run of equal positions stands for all; runs may cross block borders, so each block looks
  // back to the start of its first run.
  const auto begins_run = [&](std::size_t i) {
    return i == 0 || key[i].hash != key[i - 1].hash || point(key[i].corner) != point(key[i - 1].corner);
  };
  std::vector<Index>& corner = soup.corner;
  corner.resize(corners);
  std::vector<Index> number(corners);
  for_each_block(work, Cost::light, corners, [&](std::size_t begin, std::size_t end, std::size_t) {
    std::size_t first = begin;
    while (!begins_run(first)) --first;
    for (std::size_t i = begin; i < end; ++i) {
      if (begins_run(i)) first = i;
      corner[key[i].corner] = key[first].corner;
      number[key[i].corner] = first == i ? 1 : 0;
    }
  });
  const Index vertices = exclusive_scan<Index>(work, number);
  for (auto* a : {&soup.x, &soup.y, &soup.z}) a->resize(vertices);
  for_each(work, Cost::light, corners, [&](std::size_t c) {
    const Index representative = corner[c];
    if (representative == c) {
      const auto p = point(representative);
      soup.x[number[c]] = p[0], soup.y[number[c]] = p[1], soup.z[number[c]] = p[2];
    }
  });
  for_each(work, Cost::light, corners, [&](std::size_t c) { corner[c] = number[corner[c]]; });
}

}  // namespace intarsia
