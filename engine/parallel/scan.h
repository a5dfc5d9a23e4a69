// Exclusive prefix sum of counts.
#pragma once

#include <span>
#include <vector>

#include "engine/parallel/for_each.h"

namespace intarsia {

// Replaces counts by their exclusive prefix sums and returns the total. Integer sums are order-free.
// Requires: the total fits Index.
template <class T>
T exclusive_scan(const Work& work, std::span<T> values) {
  constexpr Cost cost = Cost::light;
  std::vector<T> block(block_count(cost, values.size()));
  for_each_block(work, cost, values.size(), [&](std::size_t begin, std::size_t end, std::size_t b) {
    T s = 0;
    for (std::size_t i = begin; i < end; ++i) s += values[i];
    block[b] = s;
  });
  T total = 0;
  for (T& b : block) {
    const T s = b;
    b = total;
    total += s;
  }
  for_each_block(work, cost, values.size(), [&](std::size_t begin, std::size_t end, std::size_t b) {
    T s = block[b];
    for (std::size_t i = begin; i < end; ++i) {
      const T v = values[i];
      values[i] = s;
      s += v;
    }
  });
  return total;
}

}  // namespace intarsia
