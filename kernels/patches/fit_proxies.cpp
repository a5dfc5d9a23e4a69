#include "kernels/patches/fit_proxies.h"

#include <algorithm>
#include <limits>

namespace intarsia::kernels {
namespace {

Vec3 unit_or_zero(const Vec3& v) {
  const Real length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3::Zero();
}

void refit(const RegionGraph& g, ProxyFit& fit) {
  const Index regions = fit.regions();
  std::vector<Vec3> sum(regions, Vec3::Zero());
  fit.area.assign(regions, 0), fit.energy.assign(regions, 0), fit.proxy.assign(regions, Vec3::Zero());
  for (Index n = 0; n < g.nodes(); ++n) {
    const Index r = fit.label[n];
    sum[r] += g.normal_sum[n];
    fit.area[r] += g.area[n];
  }
  for (Index r = 0; r < regions; ++r) {
    fit.proxy[r] = unit_or_zero(sum[r]);
    fit.energy[r] = 2 * std::max(Real{0}, fit.area[r] - sum[r].norm());
  }
  std::vector<Real> best(regions, std::numeric_limits<Real>::infinity());
  std::vector<Index> seed(regions, kNone);
  for (Index n = 0; n < g.nodes(); ++n) {
    const Index r = fit.label[n];
    const Real d = deviation(g, n, fit.proxy[r]);
    if (seed[r] == kNone || d < best[r] || (d == best[r] && g.area[n] > g.area[seed[r]])) best[r] = d, seed[r] = n;
  }
  fit.seed.swap(seed);
}

}  // namespace

Real ProxyFit::total() const {
  Real sum = 0;
  for (const Real e : energy) sum += e;
  return sum;
}

ProxyFit fit_proxies(const Work& work, const RegionGraph& g, std::vector<Index> seed, std::vector<Vec3> proxy,
                     const ProxyOptions& options) {
  ProxyFit now, best;
  now.seed = std::move(seed), now.proxy = std::move(proxy);
  if (now.proxy.empty())
    for (const Index s : now.seed) now.proxy.push_back(unit_or_zero(g.mean_normal[s]));
  std::vector<Real> history;
  int stale = 0;
  for (int i = 0; i < options.max_iterations && stale < options.patience; ++i) {
    now.label = grow_regions(work, g, now.seed, now.proxy, options.grow);
    for (Index& l : now.label)
      if (l == kNone) l = 0;  // only if the graph is not connected
    refit(g, now);
    const Real energy = now.total();
    history.push_back(energy);
    const bool first = best.label.empty();
    const Real before = first ? 0 : best.total();
    stale = first || energy < before * (1 - options.tolerance) ? 0 : stale + 1;
    if (first || energy < before) best = now;
  }
  best.history = std::move(history);
  return best;
}

std::vector<Index> farthest_normals(const RegionGraph& g, Index count) {
  std::vector<Index> seeds;
  Vec3 sum = Vec3::Zero();
  for (Index n = 0; n < g.nodes(); ++n) sum += g.normal_sum[n];
  std::vector<Real> distance(g.nodes());
  const Vec3 mean = unit_or_zero(sum);
  for (Index n = 0; n < g.nodes(); ++n) distance[n] = g.area[n] > 0 ? deviation(g, n, mean) : -1;
  while (seeds.size() < std::min(count, g.nodes())) {
    const Index s = static_cast<Index>(std::max_element(distance.begin(), distance.end()) - distance.begin());
    const Vec3 at = g.mean_normal[s];
    for (Index n = 0; n < g.nodes(); ++n) {
      const Real d = g.area[n] > 0 ? (g.mean_normal[n] - at).squaredNorm() : -1;
      distance[n] = seeds.empty() ? d : std::min(distance[n], d);
    }
    seeds.push_back(s);
    for (const Index old : seeds) distance[old] = -2;
  }
  return seeds;
}

}  // namespace intarsia::kernels
