// Joins corners that lie at exactly the same place, for files that give every triangle its own points.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "engine/base/hash.h"
#include "engine/data/mesh.h"
#include "engine/parallel/build_csr.h"
#include "engine/parallel/for_each.h"
#include "engine/parallel/scan.h"

namespace intarsia {

// point(c) -> std::array<Real, 3>, for corners c in [0, corners). Fills soup.x, y, z and soup.corner: one vertex for
// each different position (-0 equals 0), in the order of first appearance.
// Requires: corners < kNone; all coordinates finite.
template <class Point>
void weld(const Work& work, Index corners, const Point& point, Soup& soup) {
  const Index rows = corners / 4 + 1;
  std::vector<Index> row(corners);  // equal positions share a row
  for_each(work, Cost::light, corners, [&](std::size_t c) {
    Hash hash;
    for (const Real value : point(static_cast<Index>(c))) hash.add(value);
    row[c] = static_cast<Index>(hash.value() % rows);
  });
  const Csr sharing = build_csr(
      work, rows, corners, [&](std::size_t c) { return row[c]; }, [](std::size_t c) { return static_cast<Index>(c); });

  // The first corner at a position stands for all of them.
  std::vector<Index>& corner = soup.corner;
  corner.resize(corners);
  std::vector<Index>& number = row;  // no longer needed as what it was
  for_each_block(work, Cost::light, rows, [&](std::size_t begin, std::size_t end, std::size_t) {
    std::vector<Index> first;  // of the different positions in the row
    for (std::size_t r = begin; r < end; ++r) {
      first.clear();
      for (const Index c : sharing.row(static_cast<Index>(r))) {
        const auto p = point(c);
        const auto known = std::find_if(first.begin(), first.end(), [&](Index f) { return point(f) == p; });
        number[c] = known == first.end() ? 1 : 0;
        corner[c] = known == first.end() ? c : *known;
        if (known == first.end()) first.push_back(c);
      }
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
