#include "kernels/network/bridge_gaps.h"

#include <algorithm>
#include <queue>
#include <tuple>

namespace intarsia::kernels {
namespace {

// Distances with an epoch per search, so that a search costs what it visits.
class Search {
 public:
  explicit Search(Index vertices) : stamp_(vertices, 0), distance_(vertices), from_(vertices) {}

  void start() { ++epoch_; }
  bool improve(Index v, Real d, Index from) {
    if (stamp_[v] == epoch_ && distance_[v] <= d) return false;
    stamp_[v] = epoch_, distance_[v] = d, from_[v] = from;
    return true;
  }
  Real distance(Index v) const { return distance_[v]; }
  Index from(Index v) const { return from_[v]; }

 private:
  std::uint32_t epoch_ = 0;
  std::vector<std::uint32_t> stamp_;
  std::vector<Real> distance_;
  std::vector<Index> from_;
};

Real edge_cost(const Terrain& terrain, Index a, Index b) {
  const Vec3 d = terrain.point(b) - terrain.point(a);
  const Real length = d.norm();
  if (!(length > 0)) return 0;
  const Real along = terrain.direction(a).dot(d) / length;
  return length * (1 + 2 * terrain.confidence(a) * (1 - along * along));
}

bool is_tail(const Terrain& terrain, const GrowingEnd& end, Real tail, Index z) {
  Real walked = 0;
  for (std::size_t i = end.path.size(); i-- > 0 && walked < tail;) {
    if (end.path[i] == z) return true;
    if (i > 0) walked += (terrain.point(end.path[i]) - terrain.point(end.path[i - 1])).norm();
  }
  return false;
}

// The path from the tip to the network, tip excluded, or nothing.
std::vector<Index> shortest_way(const Work& work, const Terrain& terrain, const ExtensionOptions& options,
                                const std::vector<std::uint8_t>& taken, const GrowingEnd& end, Search& search) {
  using Entry = std::tuple<Real, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const Index tip = end.path.back();
  const Heading h = heading(terrain, options, end.path, end.tracer);
  search.start();
  search.improve(tip, 0, kNone);
  queue.push({0, tip});
  for (std::size_t visited = 0; !queue.empty(); ++visited) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > search.distance(v)) continue;
    if (d > 3 * options.max_gap) break;
    if (visited % 4096 == 0) work.check();
    if (v != tip && taken[v]) {
      std::vector<Index> path;
      Real length = 0;
      for (Index w = v; w != tip; w = search.from(w)) {
        path.push_back(w);
        length += (terrain.point(w) - terrain.point(search.from(w))).norm();
      }
      std::reverse(path.begin(), path.end());
      return length <= options.max_gap ? path : std::vector<Index>();
    }
    for (Index w : terrain.ring(v)) {
      if (v == tip && h.walk.dot(terrain.point(w) - terrain.point(tip)) < 0) continue;
      if (taken[w] && is_tail(terrain, end, options.own_tail * terrain.mean_edge(), w)) continue;
      const Real reach = d + edge_cost(terrain, v, w);
      if (search.improve(w, reach, v)) queue.push({reach, w});
    }
  }
  return {};
}

}  // namespace

Index bridge_gaps(const Work& work, const Terrain& terrain, const ExtensionOptions& options,
                  std::vector<std::uint8_t>& taken, std::vector<GrowingEnd>& ends) {
  Index bridged = 0;
  if (std::all_of(ends.begin(), ends.end(), [](const GrowingEnd& e) { return e.closed != 0; })) return 0;
  Search search(terrain.mesh().vertex_count());
  for (GrowingEnd& end : ends) {
    if (end.closed) continue;
    const std::vector<Index> way = shortest_way(work, terrain, options, taken, end, search);
    if (way.empty()) continue;
    const Index target = way.back();
    for (Index v : way) taken[v] = 1, end.path.push_back(v);
    end.closed = 1;
    ++bridged;
    for (GrowingEnd& other : ends)
      if (!other.closed && other.path.back() == target) other.closed = 1, ++bridged;
  }
  return bridged;
}

}  // namespace intarsia::kernels
