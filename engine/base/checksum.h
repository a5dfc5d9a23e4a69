// A 64-bit checksum of bytes at the speed of memory. Notices damage, not malice.
#pragma once

#include <cstring>

#include "engine/base/hash.h"

namespace intarsia {

// Eight independent lanes of the round of XXH64 (Collet 2012), folded by Hash.
inline std::uint64_t checksum(const void* bytes, std::size_t size) {
  constexpr std::size_t kWords = 8, kStep = kWords * sizeof(std::uint64_t);
  constexpr std::uint64_t kFirst = 0x9e3779b185ebca87ull, kSecond = 0xc2b2ae3d27d4eb4full;
  const char* at = static_cast<const char*>(bytes);
  std::uint64_t lane[kWords], word[kWords];
  for (std::size_t l = 0; l < kWords; ++l) lane[l] = mix64(l);
  const auto add = [&] {
    for (std::size_t l = 0; l < kWords; ++l) lane[l] = std::rotl(lane[l] + word[l] * kSecond, 31) * kFirst;
  };
  for (std::size_t left = size; left >= kStep; left -= kStep, at += kStep) {
    std::memcpy(word, at, kStep);
    add();
  }
  if (const std::size_t rest = size % kStep; rest > 0) {
    std::memset(word, 0, kStep);
    std::memcpy(word, at, rest);
    add();
  }
  Hash hash;
  hash.add(std::uint64_t{size});
  for (const std::uint64_t l : lane) hash.add(l);
  return hash.value();
}

}  // namespace intarsia
