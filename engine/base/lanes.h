// Eight numbers side by side, for loops whose bits must not depend on the instruction set: the compiler turns one
// operation on Lanes into whatever registers there are, and sums are folded in an order written down here.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/base/types.h"

namespace intarsia {

inline constexpr std::size_t kLanes = 8;

// Do not pass or return by value: the calling convention depends on the instruction set.
typedef Real Lanes __attribute__((vector_size(64), may_alias));

// One function, compiled for several instruction sets and chosen when the program starts. Contraction is off in every
// unit, so all of them give the same bits. Sanitizers cannot run before the choice is made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define INTARSIA_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define INTARSIA_WIDE
#endif

inline const Lanes& lanes_at(const Real* aligned) { return *reinterpret_cast<const Lanes*>(aligned); }
inline Lanes& lanes_at(Real* aligned) { return *reinterpret_cast<Lanes*>(aligned); }

// ((0+4) + (2+6)) + ((1+5) + (3+7)).
inline Real sum_of(const Lanes& v) { return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7])); }

inline constexpr std::size_t whole_lanes(std::size_t n) { return (n + kLanes - 1) / kLanes * kLanes; }

// Reals aligned for Lanes.
class LaneArray {
 public:
  // Keeps what was there, if it fits; grows to whole lanes.
  void resize(std::size_t n) { packs_.resize(whole_lanes(n) / kLanes); }
  std::size_t size() const { return packs_.size() * kLanes; }
  Real* data() { return packs_.empty() ? nullptr : packs_.data()->value; }
  const Real* data() const { return packs_.empty() ? nullptr : packs_.data()->value; }

 private:
  struct alignas(64) Pack {
    Real value[kLanes] = {};
  };
  std::vector<Pack> packs_;
};

}  // namespace intarsia
