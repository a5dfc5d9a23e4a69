// Hash of a long array, block by block side by side; block bounds depend on the length only, so the value does not
// depend on threads.
#pragma once

#include <span>
#include <vector>

#include "engine/base/hash.h"
#include "engine/parallel/for_each.h"

namespace intarsia {

template <class T>
std::uint64_t hash_array(const Work& work, std::span<const T> values) {
  std::vector<std::uint64_t> part(block_count(Cost::light, values.size()));
  for_each_block(work, Cost::light, values.size(), [&](std::size_t begin, std::size_t end, std::size_t b) {
    Hash h;
    h.add(values.subspan(begin, end - begin));
    part[b] = h.value();
  });
  Hash all;
  all.add(std::uint64_t{values.size()});
  all.add(part);
  return all.value();
}

template <class T>
std::uint64_t hash_array(const Work& work, const std::vector<T>& values) {
  return hash_array(work, std::span<const T>(values));
}

}  // namespace intarsia
