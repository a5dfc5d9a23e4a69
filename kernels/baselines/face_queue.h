// Growing regions over faces from seeds, best fit first (Cohen-Steiner, Alliez, Desbrun 2004), with a queue of buckets.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/baselines/face_graph.h"

namespace intarsia::kernels {

// A priority queue of (face, region) by a key >= 0. Keys count as equal within 1.6 %, and below kLeast; equal keys
// leave in the order they came, so flat parts are shared out by distance. Push and pop take constant time.
class FaceQueue {
 public:
  struct Entry {
    Index face, region, next;
  };

  FaceQueue() : first_(kBuckets, kNone), last_(kBuckets, kNone) {}

  bool empty() const { return top_ == 0; }
  void clear() {
    while (!empty()) pop();
    entry_.clear();
  }
  void push(Real key, Index face, Index region) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(static_cast<float>(key > kLeast ? key : kLeast));
    const std::uint32_t b = bits >> kShift;
    const Index at = static_cast<Index>(entry_.size());
    entry_.push_back({face, region, kNone});
    if (first_[b] == kNone) {
      first_[b] = at;
      low_[b / 64] |= std::uint64_t{1} << b % 64;
      mid_[b / 4096] |= std::uint64_t{1} << b / 64 % 64;
      top_ |= std::uint64_t{1} << b / 4096;
    } else {
      entry_[last_[b]].next = at;
    }
    last_[b] = at;
  }
  // Requires: not empty.
  Entry pop() {
    const std::uint32_t t = static_cast<std::uint32_t>(std::countr_zero(top_));
    const std::uint32_t m = t * 64 + static_cast<std::uint32_t>(std::countr_zero(mid_[t]));
    const std::uint32_t b = m * 64 + static_cast<std::uint32_t>(std::countr_zero(low_[m]));
    const Entry e = entry_[first_[b]];
    first_[b] = e.next;
    if (e.next == kNone) {
      low_[m] &= low_[m] - 1;
      if (low_[m] == 0) mid_[t] &= mid_[t] - 1;
      if (mid_[t] == 0) top_ &= top_ - 1;
    }
    return e;
  }

 private:
  static constexpr Real kLeast = 1e-9;
  static constexpr int kShift = 17;  // of a float's bits: sign, exponent and six of the mantissa are left
  static constexpr std::size_t kBuckets = 1 << 14;  // the sign is 0
  std::vector<Entry> entry_;
  std::vector<Index> first_, last_;
  std::array<std::uint64_t, kBuckets / 64> low_{};
  std::array<std::uint64_t, kBuckets / 4096> mid_{};
  std::uint64_t top_ = 0;
};

// Grows the regions on from where they stand: region[f] is kNone (free) or fixed.
// key(face, region) >= 0: how badly a face fits; allowed(face, region): whether it may join at all.
// Ensures: connected regions stay connected; faces that no region reaches keep kNone.
template <class Key, class Allowed>
void grow_on(const Work& work, const FaceGraph& graph, std::span<Index> region, FaceQueue& queue, const Key& key,
             const Allowed& allowed) {
  const auto push_around = [&](Index f) {
    for (const Index o : graph.around(f))
      if (o != kNone && region[o] == kNone && allowed(o, region[f])) queue.push(key(o, region[f]), o, region[f]);
  };
  queue.clear();
  for (Index f = 0; f < graph.faces(); ++f)
    if (region[f] != kNone) push_around(f);
  for (std::size_t step = 0; !queue.empty(); ++step) {
    if (step % 4096 == 0) work.check();
    const FaceQueue::Entry e = queue.pop();
    if (region[e.face] != kNone) continue;
    region[e.face] = e.region;
    push_around(e.face);
  }
}

// The same from one face a region; kNone: the region has none.
template <class Key, class Allowed>
void grow_from(const Work& work, const FaceGraph& graph, std::span<const Index> seed, std::span<Index> region,
               FaceQueue& queue, const Key& key, const Allowed& allowed) {
  std::fill(region.begin(), region.end(), kNone);
  for (Index r = 0; r < seed.size(); ++r)
    if (seed[r] != kNone) region[seed[r]] = r;
  grow_on(work, graph, region, queue, key, allowed);
}

}  // namespace intarsia::kernels
