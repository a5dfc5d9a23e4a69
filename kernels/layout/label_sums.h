// Sums of values grouped by label, in an order that does not depend on threads.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/base/types.h"
#include "engine/parallel/for_each.h"

namespace intarsia::kernels {

// result[l] = sum of value_of(i) over the items with label_of(i) == l; labels >= `labels` (kNone too) are skipped.
// One row of partial sums per chunk, folded in chunk order; chunks depend on the counts only.
template <class T, class LabelOf, class ValueOf>
std::vector<T> sum_by_label(const Work& work, std::size_t items, Index labels, const LabelOf& label_of,
                            const ValueOf& value_of) {
  constexpr std::size_t kMostPartials = 1u << 22;
  const std::size_t most_chunks = std::max<std::size_t>(1, kMostPartials / std::max<std::size_t>(1, labels));
  const std::size_t chunk = std::max<std::size_t>(8192, (items + most_chunks - 1) / most_chunks);
  const std::size_t chunks = (items + chunk - 1) / chunk;
  std::vector<T> partial(chunks * labels, T{});
  for_each(work, Cost::single, chunks, [&](std::size_t c) {
    T* row = partial.data() + c * labels;
    for (std::size_t i = c * chunk, end = std::min(items, i + chunk); i < end; ++i) {
      const Index l = label_of(i);
      if (l < labels) row[l] += value_of(i);
    }
  });
  std::vector<T> total(labels, T{});
  for_each(work, Cost::medium, labels, [&](std::size_t l) {
    for (std::size_t c = 0; c < chunks; ++c) total[l] += partial[c * labels + l];
  });
  return total;
}

}  // namespace intarsia::kernels
