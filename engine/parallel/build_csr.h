// (row, item) pairs to ascending rows, by counting; no locks, and the result does not depend on threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/csr.h"
#include "engine/parallel/scan.h"

namespace intarsia {

// For rows of a few items: a call of std::sort costs as much as they do.
template <class Iterator>
void sort_short(Iterator begin, Iterator end) {
  if (end - begin > 16) return std::sort(begin, end);
  for (Iterator i = begin; i != end; ++i) {
    const auto item = *i;
    Iterator j = i;
    for (; j != begin && item < *(j - 1); --j) *j = *(j - 1);
    *j = item;
  }
}

// row_of(i) -> row (or kNone to skip), item_of(i) -> item, for i in [0, pairs).
// Ensures: every row ascending.
template <class RowOf, class ItemOf>
Csr build_csr(const Work& work, Index rows, std::size_t pairs, const RowOf& row_of, const ItemOf& item_of) {
  Csr csr;
  csr.offset.assign(std::size_t{rows} + 1, 0);
  // The place in its row that each pair was counted at; rows longer than that count again.
  constexpr Index kShort = 255;
  std::vector<std::uint8_t> place(pairs);
  std::atomic<bool> is_long{false};
  for_each(work, Cost::light, pairs, [&](std::size_t i) {
    const Index r = row_of(i);
    if (r == kNone) return;
    const Index at = std::atomic_ref<Index>(csr.offset[r]).fetch_add(1, std::memory_order_relaxed);
    if (at >= kShort) is_long.store(true, std::memory_order_relaxed);
    place[i] = static_cast<std::uint8_t>(at);
  });
  const Index total = exclusive_scan<Index>(work, csr.offset);
  csr.item.resize(total);
  if (!is_long) {
    for_each(work, Cost::light, pairs, [&](std::size_t i) {
      const Index r = row_of(i);
      if (r != kNone) csr.item[csr.offset[r] + place[i]] = item_of(i);
    });
  } else {
    std::vector<Index> cursor(csr.offset.begin(), csr.offset.end());
    for_each(work, Cost::light, pairs, [&](std::size_t i) {
      const Index r = row_of(i);
      if (r != kNone) csr.item[std::atomic_ref<Index>(cursor[r]).fetch_add(1, std::memory_order_relaxed)] = item_of(i);
    });
  }
  for_each(work, Cost::light, rows, [&](std::size_t r) {  // the order of arrival is the schedule's: sort it away
    sort_short(csr.item.begin() + csr.offset[r], csr.item.begin() + csr.offset[r + 1]);
  });
  return csr;
}

}  // namespace intarsia
