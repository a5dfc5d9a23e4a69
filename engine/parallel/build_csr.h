// (row, item) pairs to ascending rows, by counting; no locks, and the result does not depend on threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
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

// Few items in no order at all: their ranks are counted, because branches on them cannot be predicted.
template <class T>
void sort_few(T* item, std::size_t count) {
  constexpr std::size_t kFew = 16;
  if (count > kFew) return std::sort(item, item + count);
  T old[kFew];
  std::uint32_t rank[kFew] = {};
  for (std::size_t i = 0; i < count; ++i) {
    const T x = old[i] = item[i];
    std::uint32_t smaller = 0;
    for (std::size_t j = 0; j < i; ++j) {
      const std::uint32_t before = old[j] <= x;
      smaller += before, rank[j] += 1 - before;
    }
    rank[i] = smaller;
  }
  for (std::size_t i = 0; i < count; ++i) item[rank[i]] = old[i];
}

// row_of(i) -> row (or kNone to skip), item_of(i) -> item, for i in [0, pairs); both are called more than once.
// Ensures: every row ascending.
//
// Pairs go to buckets of neighbouring rows first, and then to their rows inside caches: counting rows straight away
// takes an atomic addition a pair, three times as long.
template <class RowOf, class ItemOf>
Csr build_csr(const Work& work, Index rows, std::size_t pairs, const RowOf& row_of, const ItemOf& item_of) {
  constexpr std::size_t kBlock = std::size_t{1} << 16;  // pairs
  constexpr Index kMostBuckets = 1024;
  int shift = 12;
  while (shift < 16 && rows >> shift >= kMostBuckets) ++shift;
  const std::size_t buckets = (rows >> shift) + std::size_t{1}, blocks = (pairs + kBlock - 1) / kBlock;

  // start[bucket * blocks + block]: where the pairs of a block begin in a bucket.
  std::vector<Index> start(buckets * blocks + 1, 0);
  for_each_block(work, Cost::single, blocks, [&](std::size_t block, std::size_t, std::size_t) {
    std::vector<Index> count(buckets, 0);
    for (std::size_t i = block * kBlock, end = std::min(pairs, i + kBlock); i < end; ++i) {
      const Index r = row_of(i);
      if (r != kNone) ++count[r >> shift];
    }
    for (std::size_t b = 0; b < buckets; ++b) start[b * blocks + block] = count[b];
  });
  const Index total = exclusive_scan<Index>(work, start);
  const auto item = std::make_unique_for_overwrite<Index[]>(total);
  const auto row = std::make_unique_for_overwrite<std::uint16_t[]>(total);  // inside the bucket
  for_each_block(work, Cost::single, blocks, [&](std::size_t block, std::size_t, std::size_t) {
    std::vector<Index> next(buckets);
    for (std::size_t b = 0; b < buckets; ++b) next[b] = start[b * blocks + block];
    for (std::size_t i = block * kBlock, end = std::min(pairs, i + kBlock); i < end; ++i) {
      const Index r = row_of(i);
      if (r == kNone) continue;
      const Index at = next[r >> shift]++;
      row[at] = static_cast<std::uint16_t>(r & ((Index{1} << shift) - 1));
      item[at] = item_of(i);
    }
  });

  Csr csr;
  csr.offset.resize(std::size_t{rows} + 1);
  csr.item.resize(total);
  csr.offset[rows] = total;
  for_each_block(work, Cost::single, buckets, [&](std::size_t b, std::size_t, std::size_t) {
    const std::size_t first = b << shift, size = std::min<std::size_t>(std::size_t{1} << shift, rows - first);
    const Index begin = start[b * blocks], end = b + 1 < buckets ? start[(b + 1) * blocks] : total;
    std::vector<Index> next(size + 1, 0);
    for (Index at = begin; at < end; ++at) ++next[row[at]];
    Index sum = begin;
    for (std::size_t r = 0; r < size; ++r) {
      const Index n = next[r];
      csr.offset[first + r] = next[r] = sum;
      sum += n;
    }
    for (Index at = begin; at < end; ++at) csr.item[next[row[at]]++] = item[at];
    for (std::size_t r = 0; r < size; ++r)  // most callers' items ascend already
      sort_short(csr.item.begin() + csr.offset[first + r], csr.item.begin() + next[r]);
  });
  return csr;
}

}  // namespace intarsia
