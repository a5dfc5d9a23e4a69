// The queue of region growing: entries by (key, first, second), the least first. The order is total, so any heap gives
// the same one; this one has four children a node and compares two words.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "engine/base/types.h"

namespace intarsia::kernels {

class LeastFirst {
 public:
  struct Entry {
    std::uint64_t key, tag;
    Index first() const { return static_cast<Index>(tag >> 32); }
    Index second() const { return static_cast<Index>(tag); }
    Real value() const { return std::bit_cast<Real>(key >> 63 ? key ^ kSign : ~key); }
    bool operator<(const Entry& o) const { return key != o.key ? key < o.key : tag < o.tag; }
  };

  bool empty() const { return heap_.empty(); }
  void push(Real key, Index first, Index second) {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(key + 0.0);  // -0 as 0
    const Entry e{bits & kSign ? ~bits : bits | kSign, std::uint64_t{first} << 32 | second};
    std::size_t i = heap_.size();
    heap_.push_back(e);
    for (; i > 0 && e < heap_[(i - 1) / 4]; i = (i - 1) / 4) heap_[i] = heap_[(i - 1) / 4];
    heap_[i] = e;
  }
  Entry pop() {
    const Entry top = heap_.front(), last = heap_.back();
    heap_.pop_back();
    const std::size_t n = heap_.size();
    if (n == 0) return top;
    std::size_t i = 0;
    for (std::size_t child = 1; child < n; child = 4 * i + 1) {
      std::size_t least = child;
      for (std::size_t c = child + 1; c < child + 4 && c < n; ++c)
        if (heap_[c] < heap_[least]) least = c;
      if (!(heap_[least] < last)) break;
      heap_[i] = heap_[least];
      i = least;
    }
    heap_[i] = last;
    return top;
  }

 private:
  static constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
  std::vector<Entry> heap_;
};

}  // namespace intarsia::kernels
