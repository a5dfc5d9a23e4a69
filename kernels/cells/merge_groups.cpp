#include "kernels/cells/merge_groups.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

#include "engine/parallel/for_each.h"
#include "engine/parallel/scratch_pool.h"

namespace intarsia::kernels {
namespace {

// How well the cost of a union is known.
enum class Known : std::uint8_t { border, least, exact };

struct Pair {
  Real cost;  // a lower bound until it is exact
  Index low, high, low_version, high_version;
  Known known = Known::border;
  bool operator>(const Pair& o) const { return std::tie(cost, low, high) > std::tie(o.cost, o.low, o.high); }
};

constexpr Real kNever = std::numeric_limits<Real>::infinity();

struct UnionScratch {
  GroupScratch group;
  std::vector<Index> cells;
};

// What joining two groups costs, as far as `known` asks.
Real union_cost(const Grouping& g, const Pair& pair, UnionScratch& s) {
  const Index a = pair.low, b = pair.high;
  if (g.are_kept_apart(a, b)) return kNever;
  s.cells.clear();
  std::ranges::merge(g.cells(a), g.cells(b), std::back_inserter(s.cells));
  const int worse = std::max(g.shape(a).defect(), g.shape(b).defect());
  const int allowed = g.options().discs ? std::max(0, worse - 1) : std::numeric_limits<int>::max();
  GroupShape u = g.look_at_border(s.cells, {}, s.group);
  if (!u.connected || u.defect() > allowed) return kNever;
  if (pair.known != Known::border) u.error = g.least_error(s.cells, s.group);
  if (pair.known == Known::exact) u.error = g.error(s.group);
  return cost_of(u, g.options()) - g.cost(a) - g.cost(b);
}

}  // namespace

std::string merge_groups(const Work& work, Index target, Grouping& g) {
  constexpr std::size_t kTogether = 8;  // pairs whose cost is asked for side by side; no result depends on it
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> queue;
  auto pool = make_scratch_pool([] { return UnionScratch(); });
  std::vector<Pair> pairs;
  const auto evaluate = [&] {
    for_each_block(work, Cost::single, pairs.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
      auto scratch = pool.borrow();
      for (std::size_t i = begin; i < end; ++i) pairs[i].cost = union_cost(g, pairs[i], *scratch);
    });
    for (const Pair& p : pairs)
      if (p.cost < kNever) queue.push(p);
    pairs.clear();
  };
  const auto add = [&](Index a, Index b) {
    const Index low = std::min(a, b), high = std::max(a, b);
    pairs.push_back({0, low, high, g.version(low), g.version(high)});
  };
  // The most promising pairs, until one is met whose cost is exact.
  const auto take_unknown = [&] {
    while (!queue.empty() && queue.top().known != Known::exact && pairs.size() < kTogether) {
      Pair p = queue.top();
      queue.pop();
      if (g.version(p.low) != p.low_version || g.version(p.high) != p.high_version) continue;
      p.known = p.known == Known::border ? Known::least : Known::exact;
      pairs.push_back(p);
    }
  };
  for (Index a = 0; a < g.size(); ++a)
    for (const Index b : g.neighbours(a))
      if (a < b) add(a, b);
  evaluate();
  while (g.alive() > target && !queue.empty()) {
    take_unknown();
    if (!pairs.empty()) {
      evaluate();
      continue;
    }
    if (queue.empty()) break;
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
