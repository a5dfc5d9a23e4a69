#include "kernels/cells/merge_groups.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

#include "engine/parallel/for_each.h"
#include "engine/parallel/scratch_pool.h"

namespace intarsia::kernels {
namespace {

struct Pair {
  Real cost;
  Index low, high, low_version, high_version;
  bool operator>(const Pair& o) const { return std::tie(cost, low, high) > std::tie(o.cost, o.low, o.high); }
};

Real union_cost(const Grouping& g, Index a, Index b, GroupScratch& scratch) {
  constexpr Real kNever = std::numeric_limits<Real>::infinity();
  if (g.are_kept_apart(a, b)) return kNever;
  std::vector<Index> cells;
  std::ranges::merge(g.cells(a), g.cells(b), std::back_inserter(cells));
  const int worse = std::max(g.shape(a).defect(), g.shape(b).defect());
  const int allowed = g.options().discs ? std::max(0, worse - 1) : std::numeric_limits<int>::max();
  const GroupShape u = g.look(cells, {}, allowed, scratch);
  if (!u.connected || u.defect() > allowed) return kNever;
  return cost_of(u, g.options()) - g.cost(a) - g.cost(b);
}

}  // namespace

std::string merge_groups(const Work& work, Index target, Grouping& g) {
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> queue;
  auto pool = make_scratch_pool([] { return GroupScratch(); });
  std::vector<Pair> pairs;
  const auto evaluate = [&] {
    for_each_block(work, Cost::single, pairs.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
      auto scratch = pool.borrow();
      for (std::size_t i = begin; i < end; ++i) pairs[i].cost = union_cost(g, pairs[i].low, pairs[i].high, *scratch);
    });
    for (const Pair& p : pairs)
      if (p.cost < std::numeric_limits<Real>::infinity()) queue.push(p);
    pairs.clear();
  };
  const auto add = [&](Index a, Index b) {
    const Index low = std::min(a, b), high = std::max(a, b);
    pairs.push_back({0, low, high, g.version(low), g.version(high)});
  };
  for (Index a = 0; a < g.size(); ++a)
    for (const Index b : g.neighbours(a))
      if (a < b) add(a, b);
  evaluate();
  while (g.alive() > target && !queue.empty()) {
    const Pair top = queue.top();
    queue.pop();
    if (g.version(top.low) != top.low_version || g.version(top.high) != top.high_version) continue;
    g.merge(work, top.low, top.high);
    for (const Index b : g.neighbours(top.low)) add(top.low, b);
    evaluate();
  }
  return g.alive() > target ? "no two neighbouring patches can be joined to a disc below this number" : "";
}

}  // namespace intarsia::kernels
