// Lock-free disjoint sets; the smaller id becomes the root, so the partition and its roots do not depend on threads.
#pragma once

#include <atomic>
#include <numeric>
#include <vector>

#include "engine/base/types.h"

namespace intarsia {

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

  // The smallest id of i's set, as far as unions have finished. Safe beside unite().
  Index find(Index i) {
    for (;;) {
      const Index p = at(i).load(std::memory_order_relaxed);
      if (p == i) return i;
      const Index g = at(p).load(std::memory_order_relaxed);
      if (g != p) {
        Index expected = p;
        at(i).compare_exchange_weak(expected, g, std::memory_order_relaxed);  // path halving
      }
      i = p;
    }
  }
  void unite(Index a, Index b) {
    for (;;) {
      a = find(a), b = find(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      Index expected = a;
      if (at(a).compare_exchange_strong(expected, b, std::memory_order_acq_rel)) return;
    }
  }

 private:
  std::atomic_ref<Index> at(Index i) { return std::atomic_ref<Index>(parent_[i]); }
  std::vector<Index> parent_;
};

}  // namespace intarsia
