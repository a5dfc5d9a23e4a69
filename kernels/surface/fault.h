// Elements of one kind of fault or repair: how many, and the first few by name.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/base/types.h"

namespace intarsia::kernels {

struct Fault {
  static constexpr std::size_t kNamed = 5;
  std::uint64_t count = 0;
  std::vector<Index> first;  // the smallest ids, at most kNamed; faces as Soup::source_of names them
};

// `named`: ids in any order, the smallest kNamed different ones among them.
inline Fault fault_of(std::vector<Index> named, std::uint64_t count) {
  std::sort(named.begin(), named.end());
  named.erase(std::unique(named.begin(), named.end()), named.end());
  if (named.size() > Fault::kNamed) named.resize(Fault::kNamed);
  return {count, std::move(named)};
}

}  // namespace intarsia::kernels
