// Counter-based random numbers: a value is a pure function of (seed, stream, element, draw), so it does not depend on
// the order in which elements are visited or on the number of threads.
#pragma once

#include <cmath>
#include <cstdint>

#include "engine/base/hash.h"

namespace intarsia {

class Random {
 public:
  constexpr Random(std::uint64_t seed, std::uint64_t stream) : key_(mix64(mix64(seed) ^ (stream * 0xd1342543de82ef95ull))) {}

  constexpr std::uint64_t bits(std::uint64_t element, std::uint64_t draw = 0) const {
    return mix64(mix64(key_ ^ element) + draw * 0x9fb21c651e98df25ull);
  }
  // Uniform in [0, 1).
  constexpr double uniform(std::uint64_t element, std::uint64_t draw = 0) const {
    return static_cast<double>(bits(element, draw) >> 11) * 0x1.0p-53;
  }
  // Standard normal (Box, Muller 1958); uses draws 2*draw and 2*draw + 1.
  double normal(std::uint64_t element, std::uint64_t draw = 0) const {
    const double u = 1.0 - uniform(element, 2 * draw), v = uniform(element, 2 * draw + 1);
    return std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * v);
  }

 private:
  std::uint64_t key_;
};

}  // namespace intarsia
