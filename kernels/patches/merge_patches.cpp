#include "kernels/patches/merge_patches.h"

#include <algorithm>
#include <numbers>
#include <queue>
#include <tuple>
#include <vector>

#include "kernels/patches/flood_patches.h"

namespace intarsia::kernels {
namespace {

Real winding(Real area, Real perimeter, Real allowed) {
  return std::max(Real{0}, perimeter * perimeter / (4 * std::numbers::pi) - allowed * area);
}

bool loses_disc(const PatchGraph& graph, Index p, const Border& b) {
  const int euler = graph.union_euler(p, b);
  return std::abs(1 - euler) > graph[p].defect() + graph[b.other].defect();
}

}  // namespace

Real merge_cost(const PatchGraph& graph, Index p, const Border& b, const MergeOptions& options) {
  const PatchNode &x = graph[p], &y = graph[b.other];
  const Real bend = winding(x.area + y.area, graph.union_perimeter(p, b), options.free_winding) -
                    winding(x.area, x.perimeter, options.free_winding) -
                    winding(y.area, y.perimeter, options.free_winding);
  return graph.union_energy_increase(p, b) + options.salience_weight * b.salience - options.border_reward * b.length +
         options.compactness * std::max(Real{0}, bend);
}

namespace {

// Is the border a crease all around, on average? Then even a narrow patch is a face of the part: a side of a bar.
bool is_between_creases(const PatchNode& n, const MergeOptions& options) {
  Real salience = 0, length = 0;
  for (const Border& b : n.borders) salience += b.salience, length += b.length;
  return salience >= options.crease * options.crease * length;
}

}  // namespace

bool is_tiny(const PatchGraph& graph, Index p, const PatchSurface& surface, const MergeOptions& options) {
  const PatchNode& n = graph[p];
  if (n.area < options.tiny_area * surface.total_area) return true;
  const Real narrow = std::min(options.tiny_width * surface.mean_edge, options.widest_tiny);
  return 2 * n.area < narrow * n.perimeter && !is_between_creases(n, options);
}

Index merge_tiny(const Work& work, const PatchSurface& surface, const MergeOptions& options, PatchGraph& graph) {
  using Entry = std::tuple<Real, Index, Index>;  // area, patch, version
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (Index p = 0; p < graph.size(); ++p)
    if (graph[p].alive && is_tiny(graph, p, surface, options)) queue.push({graph[p].area, p, graph[p].version});
  Index merged = 0;
  for (Index step = 0; !queue.empty(); ++step) {
    if (step % 256 == 0) work.check();
    const auto [area, p, version] = queue.top();
    queue.pop();
    if (!graph[p].alive || graph[p].version != version) continue;
    std::tuple<bool, Real, Index> best{true, 0, kNone};
    for (const Border& b : graph[p].borders) {
      if (!b.may_vanish()) continue;
      const bool loses = loses_disc(graph, p, b);
      if (loses && options.keep_discs) continue;
      const std::tuple<bool, Real, Index> candidate{loses, merge_cost(graph, p, b, options), b.other};
      if (std::get<2>(best) == kNone || candidate < best) best = candidate;
    }
    if (std::get<2>(best) == kNone) continue;
    const Index kept = graph.merge(p, std::get<2>(best));
    ++merged;
    if (is_tiny(graph, kept, surface, options)) queue.push({graph[kept].area, kept, graph[kept].version});
  }
  return merged;
}

void merge_cheapest(const Work& work, const MergeOptions& options, Index target,
                    const std::function<bool(Index, const Border&)>& allowed, PatchGraph& graph) {
  struct Entry {
    Real cost;
    Index p, q, version_p, version_q;
    bool operator>(const Entry& o) const { return std::tie(cost, p, q) > std::tie(o.cost, o.p, o.q); }
  };
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto push = [&](Index p, const Border& b) {
    if (!b.may_vanish() || !allowed(p, b)) return;
    const Index low = std::min(p, b.other), high = std::max(p, b.other);
    queue.push({merge_cost(graph, p, b, options), low, high, graph[low].version, graph[high].version});
  };
  for (Index p = 0; p < graph.size(); ++p)
    for (const Border& b : graph[p].borders)
      if (p < b.other) push(p, b);
  for (Index step = 0; graph.alive() > target && !queue.empty(); ++step) {
    if (step % 256 == 0) work.check();
    const Entry top = queue.top();
    queue.pop();
    if (!graph[top.p].alive || !graph[top.q].alive || graph[top.p].version != top.version_p ||
        graph[top.q].version != top.version_q)
      continue;
    const Index kept = graph.merge(top.p, top.q);
    for (const Border& b : graph[kept].borders) push(kept, b);
  }
}

PatchLabels merge_patches(const Work& work, const PatchSurface& surface, const PatchLabels& labels,
                          const MergeOptions& options) {
  PatchGraph graph(work, surface, labels);
  merge_tiny(work, surface, options, graph);
  return graph.labels(work, labels);
}

Index count_after_merge(const Work& work, const PatchSurface& surface, std::span<const std::uint8_t> on_network,
                        const MergeOptions& options) {
  PatchGraph graph(work, surface, flood_patches(work, surface.mesh, on_network));
  merge_tiny(work, surface, options, graph);
  return graph.alive();
}

}  // namespace intarsia::kernels
