// Hash of a long array at the speed of memory, block by block side by side; block bounds depend on the length only, so
// the value does not depend on threads. Floating-point values by their bits, -0 as 0.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "engine/base/hash.h"
#include "engine/parallel/for_each.h"

namespace intarsia {

// Eight independent lanes of the round of XXH64 (Collet 2012), folded by Hash. Not the value that Hash::add gives.
template <class T>
requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) std::uint64_t hash_run(std::span<const T> values) {
  static_assert(std::endian::native == std::endian::little && sizeof(T) <= 8);
  constexpr std::size_t kWords = 8, kStep = kWords * sizeof(std::uint64_t) / sizeof(T);
  constexpr std::uint64_t kFirst = 0x9e3779b185ebca87ull, kSecond = 0xc2b2ae3d27d4eb4full;
  std::uint64_t lane[kWords], word[kWords];
  for (std::size_t l = 0; l < kWords; ++l) lane[l] = mix64(l);
  const auto add = [&](const T* from, std::size_t count) {
    T step[kStep] = {};
    for (std::size_t i = 0; i < count; ++i) {
      if constexpr (std::is_floating_point_v<T>)
        step[i] = from[i] + T{0};
      else
        step[i] = from[i];
    }
    std::memcpy(word, step, sizeof word);
    for (std::size_t l = 0; l < kWords; ++l) lane[l] = std::rotl(lane[l] + word[l] * kSecond, 31) * kFirst;
  };
  const std::size_t whole = values.size() / kStep * kStep;
  for (std::size_t i = 0; i < whole; i += kStep) add(values.data() + i, kStep);
  if (whole < values.size()) add(values.data() + whole, values.size() - whole);
  Hash hash;
  hash.add(std::uint64_t{values.size()});
  for (const std::uint64_t l : lane) hash.add(l);
  return hash.value();
}

template <class T>
std::uint64_t hash_array(const Work& work, std::span<const T> values) {
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  std::vector<std::uint64_t> part((values.size() + kBlock - 1) / kBlock);
  for_each_block(work, Cost::single, part.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t b = begin; b < end; ++b)
      part[b] = hash_run(values.subspan(b * kBlock, std::min(kBlock, values.size() - b * kBlock)));
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
