// (row, item) pairs to ascending rows, by counting; no locks, and the result does not depend on threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <span>
#include <vector>

#include "engine/data/csr.h"
#include "engine/parallel/scan.h"

namespace intarsia {

// row_of(i) -> row (or kNone to skip), item_of(i) -> item, for i in [0, pairs).
// Ensures: every row ascending.
template <class RowOf, class ItemOf>
Csr build_csr(const Work& work, Index rows, std::size_t pairs, const RowOf& row_of, const ItemOf& item_of) {
  Csr csr;
  csr.offset.assign(std::size_t{rows} + 1, 0);
  const auto count = [&](Index r) { return std::atomic_ref<Index>(csr.offset[r]); };
  for_each(work, Cost::light, pairs, [&](std::size_t i) {
    const Index r = row_of(i);
    if (r != kNone) count(r).fetch_add(1, std::memory_order_relaxed);
  });
  const Index total = exclusive_scan<Index>(work, csr.offset);
  csr.item.resize(total);
  std::vector<Index> cursor(csr.offset.begin(), csr.offset.end());
  for_each(work, Cost::light, pairs, [&](std::size_t i) {
    const Index r = row_of(i);
    if (r != kNone) csr.item[std::atomic_ref<Index>(cursor[r]).fetch_add(1, std::memory_order_relaxed)] = item_of(i);
  });
  for_each(work, Cost::light, rows, [&](std::size_t r) {  // the order of arrival is the schedule's: sort it away
    std::sort(csr.item.begin() + csr.offset[r], csr.item.begin() + csr.offset[r + 1]);
  });
  return csr;
}

}  // namespace intarsia
