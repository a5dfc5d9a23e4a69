// Greedy growth: many ends compete for elements, the cheapest step first. Three orders of events:
//   rounds   every round, all ends of the lowest occupied cost band step at once; where two want the same element the
//            cheaper (then the lower id) wins. A function of the input only: deterministic reservations after Blelloch,
//            Fineman, Gibbons, Shun 2012, bands after Meyer, Sanders 2003. With one thread or many: the same bits.
//   queue    one step at a time, the cheapest of all: the sequential priority queue of Cao, Yan, Wonka 2014.
//   relaxed  oneTBB's concurrent priority queue, every thread takes what is cheapest now: not reproducible; exists to
//            show what the fixed order costs. Chosen by the run setting, never by a kernel.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include <tbb/concurrent_priority_queue.h>
#include <tbb/parallel_for.h>

#include "engine/base/types.h"
#include "engine/parallel/for_each.h"

namespace intarsia {

inline constexpr Real kNoStep = std::numeric_limits<Real>::infinity();

enum class GreedyOrder { rounds, queue };

struct GreedyOptions {
  GreedyOrder order = GreedyOrder::rounds;
  Real band = 1.0 / 16;  // width of a cost band
};

// The rules of the game, given by the kernel:
//   Real propose(Index end)          plans the end's next step from the present state and returns its cost, or kNoStep
//                                    if the end is closed or stuck. Calls for different ends may run side by side.
//   void list_claims(Index end, std::vector<Index>& out)   appends the elements that the planned step will take.
//   bool commit(Index end)           takes them and moves the end; false if one of them is gone (relaxed order only).
// Requires: every committed step either closes an end or takes at least one element, so that the game ends.
template <class Rules>
class Greedy {
 public:
  Greedy(const Work& work, Index ends, Index elements, Rules& rules, const GreedyOptions& options)
      : work_(work), ends_(ends), elements_(elements), rules_(rules), options_(options) {}

  void run() {
    if (work_.order() == Order::relaxed) return run_relaxed();
    if (options_.order == GreedyOrder::queue) return run_queue();
    run_rounds();
  }

 private:
  void run_rounds() {
    std::vector<Real> cost(ends_);
    std::vector<Index> active(ends_);
    for (Index e = 0; e < ends_; ++e) active[e] = e;
    std::vector<std::uint32_t> taken(elements_, 0);
    std::vector<Index> claims, winners;
    propose_all(active, cost);
    for (std::uint32_t round = 1;; ++round) {
      const long band = lowest_band(cost);
      if (band < 0) return;
      active.clear();
      for (Index e = 0; e < ends_; ++e)
        if (band_of(cost[e]) == band) active.push_back(e);
      propose_all(active, cost);
      std::erase_if(active, [&](Index e) { return band_of(cost[e]) != band; });
      std::sort(active.begin(), active.end(),
                [&](Index a, Index b) { return std::pair(cost[a], a) < std::pair(cost[b], b); });
      winners.clear();
      for (Index e : active) {
        claims.clear();
        rules_.list_claims(e, claims);
        if (std::any_of(claims.begin(), claims.end(), [&](Index x) { return taken[x] == round; })) continue;
        for (Index x : claims) taken[x] = round;
        winners.push_back(e);
      }
      for (Index e : winners) rules_.commit(e);
      propose_all(winners, cost);
      work_.check();
    }
  }

  void propose_all(const std::vector<Index>& which, std::vector<Real>& cost) {
    for_each(work_, Cost::heavy, which.size(), [&](std::size_t i) { cost[which[i]] = rules_.propose(which[i]); });
  }
  long band_of(Real cost) const { return cost == kNoStep ? -1 : std::lround(std::floor(cost / options_.band)); }
  long lowest_band(const std::vector<Real>& cost) const {
    long lowest = -1;
    for (Real c : cost) {
      const long b = band_of(c);
      if (b >= 0 && (lowest < 0 || b < lowest)) lowest = b;
    }
    return lowest;
  }

  struct Entry {
    Real cost;
    Index end;
    bool operator<(const Entry& o) const { return std::pair(cost, end) > std::pair(o.cost, o.end); }
  };

  void run_queue() {
    std::priority_queue<Entry> queue;
    const auto push = [&](Index e) {
      const Real c = rules_.propose(e);
      if (c != kNoStep) queue.push({c, e});
    };
    for (Index e = 0; e < ends_; ++e) push(e);
    for (std::size_t step = 0; !queue.empty(); ++step) {
      const Entry top = queue.top();
      queue.pop();
      const Real now = rules_.propose(top.end);  // the state may have changed since it was queued
      if (now == kNoStep) continue;
      if (now > top.cost) {
        queue.push({now, top.end});
        continue;
      }
      rules_.commit(top.end);
      push(top.end);
      if (step % 256 == 0) work_.check();
    }
  }

  void run_relaxed() {
    tbb::concurrent_priority_queue<Entry> queue;
    for (Index e = 0; e < ends_; ++e) {
      const Real c = rules_.propose(e);
      if (c != kNoStep) queue.push({c, e});
    }
    tbb::parallel_for(0, 64, [&](int) {
      Entry top{};
      while (!work_.cancelled() && queue.try_pop(top)) {
        const Real now = rules_.propose(top.end);
        if (now == kNoStep) continue;
        if (now <= top.cost) rules_.commit(top.end);
        const Real next = now <= top.cost ? rules_.propose(top.end) : now;
        if (next != kNoStep) queue.push({next, top.end});
      }
    });
    work_.check();
  }

  const Work& work_;
  Index ends_, elements_;
  Rules& rules_;
  GreedyOptions options_;
};

}  // namespace intarsia
