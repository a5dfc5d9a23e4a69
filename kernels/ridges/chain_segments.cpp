#include "kernels/ridges/chain_segments.h"

#include <utility>

#include "engine/parallel/build_csr.h"
#include "engine/parallel/compact.h"
#include "engine/parallel/union_find.h"

namespace intarsia::kernels {

namespace {

// Slot = position in the node -> segments rows; it names one end of one segment.
class Walker {
 public:
  Walker(const Work& work, Index nodes, std::span<const Index> a, std::span<const Index> b,
         std::span<const std::uint8_t> stop)
      : a_(a), b_(b), stop_(stop) {
    slots_ = build_csr(
        work, nodes, 2 * a.size(), [&](std::size_t i) { return i % 2 ? b[i / 2] : a[i / 2]; },
        [](std::size_t i) { return static_cast<Index>(i / 2); });
  }
  const Csr& slots() const { return slots_; }
  bool ends_at(Index node) const { return slots_.row(node).size() != 2 || (!stop_.empty() && stop_[node]); }
  Index across(Index segment, Index node) const { return a_[segment] == node ? b_[segment] : a_[segment]; }
  Index slot_of(Index node, Index segment) const {
    Index s = slots_.offset[node];
    while (slots_.item[s] != segment) ++s;
    return s;
  }
  // Visits the nodes after `node`, leaving by `slot`, up to the next end or back at `node`. Returns the last slot.
  template <class Visit>
  Index walk(const Work& work, Index node, Index slot, const Visit& visit) const {
    const Index home = node;
    for (Index steps = 1;; ++steps) {
      const Index segment = slots_.item[slot];
      node = across(segment, node);
      visit(node);
      const Index arrival = slot_of(node, segment);
      if (node == home || ends_at(node)) return arrival;
      slot = slots_.offset[node] + (arrival == slots_.offset[node] ? 1 : 0);
      if (steps % 4096 == 0 && work.cancelled()) return arrival;  // the loop around reports it
    }
  }

 private:
  std::span<const Index> a_, b_;
  std::span<const std::uint8_t> stop_;
  Csr slots_;
};

}  // namespace

Csr chain_segments(const Work& work, Index node_count, std::span<const Index> a, std::span<const Index> b,
                   std::span<const std::uint8_t> stop) {
  const Walker walker(work, node_count, a, b, stop);
  const Csr& slots = walker.slots();
  std::vector<Index> points(slots.item.size(), 0), owner(slots.item.size());
  std::vector<std::uint8_t> seen(node_count, 0);
  const auto mark = [&](Index n) { std::atomic_ref<std::uint8_t>(seen[n]).store(1, std::memory_order_relaxed); };
  for_each(work, Cost::medium, node_count, [&](std::size_t n) {
    const Index node = static_cast<Index>(n);
    const bool head = walker.ends_at(node);
    for (Index s = slots.offset[n]; s < slots.offset[n + 1]; ++s) {
      owner[s] = node;
      if (!head) continue;
      Index count = 1;
      const Index tail = walker.walk(work, node, s, [&](Index) { ++count; });
      if (s > tail) continue;  // the walk from the other end keeps this chain
      points[s] = count;
      mark(node);
      walker.walk(work, node, s, mark);
    }
  });

  // What is left unseen are loops without an end; the smallest node stands for each.
  std::vector<Index> loops;
  const auto in_loop = [&](Index n) { return !seen[n] && slots.row(n).size() == 2; };
  const auto unseen = compact(work, node_count, [&](std::size_t n) { return in_loop(static_cast<Index>(n)); });
  if (!unseen.empty()) {
    UnionFind sets(node_count);
    for_each(work, Cost::medium, a.size(), [&](std::size_t i) {
      if (in_loop(a[i])) sets.unite(a[i], b[i]);
    });
    for (Index n : unseen)
      if (sets.find(n) == n) {
        const Index s0 = slots.offset[n], s1 = s0 + 1;
        const Index n0 = walker.across(slots.item[s0], n), n1 = walker.across(slots.item[s1], n);
        loops.push_back(n1 < n0 ? s1 : s0);
      }
  }
  std::vector<Index> first = compact(work, points.size(), [&](std::size_t s) { return points[s] > 0; });
  for_each(work, Cost::heavy, loops.size(), [&](std::size_t i) {
    Index count = 1;
    walker.walk(work, owner[loops[i]], loops[i], [&](Index) { ++count; });
    points[loops[i]] = count;
  });
  first.insert(first.end(), loops.begin(), loops.end());

  Csr chains;
  chains.offset.assign(first.size() + 1, 0);
  for_each(work, Cost::light, first.size(), [&](std::size_t i) { chains.offset[i] = points[first[i]]; });
  chains.item.resize(exclusive_scan<Index>(work, chains.offset));
  for_each(work, Cost::heavy, first.size(), [&](std::size_t i) {
    Index at = chains.offset[i];
    chains.item[at++] = owner[first[i]];
    walker.walk(work, owner[first[i]], first[i], [&](Index n) { chains.item[at++] = n; });
  });
  return chains;
}

}  // namespace intarsia::kernels
