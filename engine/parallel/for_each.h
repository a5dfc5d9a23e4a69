// Blocked parallel loops. Block bounds depend on the item count only; cancellation is polled once per block.
#pragma once

#include <algorithm>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "engine/parallel/work.h"

namespace intarsia {

inline std::size_t block_count(Cost cost, std::size_t items) {
  const std::size_t size = static_cast<std::size_t>(cost);
  return (items + size - 1) / size;
}

// body(begin, end, block): one call per block of at most `cost` items. Scratch memory belongs inside the body.
// Ensures: throws ErrorCode::cancelled instead of returning after an incomplete loop.
template <class Body>
void for_each_block(const Work& work, Cost cost, std::size_t items, const Body& body) {
  const std::size_t size = static_cast<std::size_t>(cost), blocks = block_count(cost, items);
  const auto run = [&](std::size_t b) {
    if (work.cancelled()) return;
    const std::size_t begin = b * size, end = std::min(items, begin + size);
    body(begin, end, b);
    work.tick(end - begin);
  };
  if (blocks <= 1) {
    if (blocks == 1) run(0);
  } else {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks, 1), [&](const auto& range) {
      for (std::size_t b = range.begin(); b != range.end(); ++b) run(b);
    });
  }
  work.check();
}

// body(i) for every i in [0, items).
template <class Body>
void for_each(const Work& work, Cost cost, std::size_t items, const Body& body) {
  for_each_block(work, cost, items, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

// Runs the given functions side by side; each writes its own outputs.
template <class F, class G>
void in_parallel(const F& f, const G& g) {
  tbb::parallel_for(0, 2, [&](int i) { i == 0 ? f() : g(); });
}

}  // namespace intarsia
