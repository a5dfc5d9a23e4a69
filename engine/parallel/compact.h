// Stable filter by count, scan, write.
#pragma once

#include <vector>

#include "engine/base/types.h"
#include "engine/parallel/scan.h"

namespace intarsia {

// The indices i in [0, items) with keep(i), ascending. `keep` is called twice per item and must be pure.
template <class Keep>
std::vector<Index> compact(const Work& work, std::size_t items, const Keep& keep) {
  constexpr Cost cost = Cost::light;
  std::vector<Index> start(block_count(cost, items));
  for_each_block(work, cost, items, [&](std::size_t begin, std::size_t end, std::size_t b) {
    Index n = 0;
    for (std::size_t i = begin; i < end; ++i) n += keep(i) ? 1 : 0;
    start[b] = n;
  });
  const Index total = exclusive_scan<Index>(work, start);
  std::vector<Index> kept(total);
  for_each_block(work, cost, items, [&](std::size_t begin, std::size_t end, std::size_t b) {
    Index at = start[b];
    for (std::size_t i = begin; i < end; ++i)
      if (keep(i)) kept[at++] = static_cast<Index>(i);
  });
  return kept;
}

}  // namespace intarsia
