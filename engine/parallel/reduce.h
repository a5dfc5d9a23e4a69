// Ordered reduction: one partial per block, folded from left to right, so that sums of floats do not depend on threads.
#pragma once

#include <vector>

#include "engine/parallel/for_each.h"

namespace intarsia {

// map_block(begin, end) -> T for each block; combine(T, T) -> T folds them in block order, starting from identity.
template <class T, class Map, class Combine>
T reduce(const Work& work, Cost cost, std::size_t items, T identity, const Map& map_block, const Combine& combine) {
  std::vector<T> partial(block_count(cost, items), identity);
  for_each_block(work, cost, items,
                 [&](std::size_t begin, std::size_t end, std::size_t b) { partial[b] = map_block(begin, end); });
  T result = identity;
  for (const T& p : partial) result = combine(result, p);
  return result;
}

// Sum of value(i), ordered.
template <class T, class Value>
T sum(const Work& work, Cost cost, std::size_t items, T zero, const Value& value) {
  return reduce(
      work, cost, items, zero,
      [&](std::size_t begin, std::size_t end) {
        T s = zero;
        for (std::size_t i = begin; i < end; ++i) s = s + value(i);
        return s;
      },
      [](const T& a, const T& b) -> T { return a + b; });
}

}  // namespace intarsia
