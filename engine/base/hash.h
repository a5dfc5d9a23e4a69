// Stable 64-bit hashes of arrays and options: the same bytes give the same hash on every run and thread count.
// Not cryptographic. Floating-point values are hashed by their bits, with -0 folded into 0.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace intarsia {

// Finaliser of splitmix64 (Steele, Lea, Flood 2014): a bijection with good avalanche.
constexpr std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

class Hash {
 public:
  void add(std::uint64_t value) { state_ = mix64(state_ ^ value) + std::rotl(state_, 23); }
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    for (unsigned char c : text) add(std::uint64_t{c});
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value)); }
  void add(float value) { add(std::uint64_t{std::bit_cast<std::uint32_t>(value == 0.0f ? 0.0f : value)}); }
  template <class T>
    requires(std::is_integral_v<T> || std::is_enum_v<T>)
  void add(T value) { add(static_cast<std::uint64_t>(value)); }
  template <class T>
  void add(std::span<const T> values) {
    add(std::uint64_t{values.size()});
    for (const T& v : values) add(v);
  }
  template <class T>
  void add(const std::vector<T>& values) { add(std::span<const T>(values)); }

  std::uint64_t value() const { return mix64(state_); }

 private:
  std::uint64_t state_ = 0x243f6a8885a308d3ull;
};

}  // namespace intarsia
