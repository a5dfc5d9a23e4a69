// Part of the eight lanes in one register, for bodies that are compiled once per instruction set. Include from .cpp
// files only. Never pass packs by value: how they travel depends on the set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/base/lanes.h"

namespace intarsia::kernels {

template <std::size_t Width>
struct LaneTypes;
template <>
struct LaneTypes<8> {
  typedef Real Reals __attribute__((vector_size(64), may_alias));
  typedef std::int64_t Integers __attribute__((vector_size(64), may_alias));
};
template <>
struct LaneTypes<4> {
  typedef Real Reals __attribute__((vector_size(32), may_alias));
  typedef std::int64_t Integers __attribute__((vector_size(32), may_alias));
};
template <>
struct LaneTypes<2> {
  typedef Real Reals __attribute__((vector_size(16), may_alias));
  typedef std::int64_t Integers __attribute__((vector_size(16), may_alias));
};

}  // namespace intarsia::kernels
