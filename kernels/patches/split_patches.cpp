#include "kernels/patches/split_patches.h"

#include <algorithm>

#include "engine/base/random.h"
#include "engine/parallel/for_each.h"
#include "kernels/patches/normal_spread.h"

namespace intarsia::kernels {
namespace {

// Spread of every region. With the literal rule each face speaks, otherwise each node.
std::vector<Real> spreads(const PatchSurface& s, const Region& region, const RegionGraph& g,
                          std::span<const Index> label, Index regions, const SplitOptions& options) {
  std::vector<std::vector<WeightedNormal>> normals(regions);
  if (options.literal) {
    for (std::size_t i = 0; i < region.faces.size(); ++i) {
      const Index f = region.faces[i];
      normals[label[g.node_of_face[i]]].push_back({s.area[f] > 0 ? s.normal[f] : Vec3::Zero(), s.area[f]});
    }
  } else {
    for (Index n = 0; n < g.nodes(); ++n) {
      const Vec3 sum = g.normal_sum[n];
      const Real length = sum.norm();
      normals[label[n]].push_back({length > 0 ? Vec3(sum / length) : Vec3::Zero(), g.area[n]});
    }
  }
  std::vector<Real> spread(regions);
  for (Index r = 0; r < regions; ++r)
    spread[r] =
        options.literal ? max_pair_angle(normals[r], options.max_spread) : trimmed_spread(normals[r], options.trim);
  return spread;
}

// The node of a region that fits its proxy worst. Ties: smaller id.
Index worst_node(const RegionGraph& g, const ProxyFit& fit, Index r) {
  Index worst = kNone;
  Real most = 0;
  for (Index n = 0; n < g.nodes(); ++n)
    if (fit.label[n] == r && n != fit.seed[r] && g.area[n] > 0)
      if (const Real d = deviation(g, n, fit.proxy[r]); worst == kNone || d > most) most = d, worst = n;
  return worst;
}

std::vector<Index> first_seeds(const RegionGraph& g, Index count, Index patch, const SplitOptions& options) {
  count = std::min(count, g.nodes());
  if (!options.random_seeds) return farthest_normals(g, count);
  const Random random(options.seed, patch);
  std::vector<Index> seeds;
  for (std::uint64_t draw = 0; seeds.size() < count; ++draw) {
    const Index n = static_cast<Index>(random.bits(0, draw) % g.nodes());
    if (std::find(seeds.begin(), seeds.end(), n) == seeds.end()) seeds.push_back(n);
  }
  return seeds;
}

// Adds seeds to the fit, one in each of the given regions, and continues from its proxies.
ProxyFit with_more_seeds(const Work& work, const RegionGraph& g, const ProxyFit& fit, std::span<const Index> worst,
                         const FitOptions& options) {
  std::vector<Index> seed = fit.seed;
  std::vector<Vec3> proxy = fit.proxy;
  for (const Index r : worst) {
    const Index n = worst_node(g, fit, r);
    if (n == kNone) continue;
    seed.push_back(n);
    proxy.push_back(g.mean_normal[n].normalized());
  }
  if (seed.size() == fit.seed.size()) return fit;
  return fit_proxies(work, g, std::move(seed), std::move(proxy), options);
}

Index write_regions(const Work& work, const PatchSurface& s, const Region& region, const RegionGraph& g,
                    const ProxyFit& fit, const SplitOptions& options, Regions& regions) {
  if (g.is_faces) {
    for (std::size_t i = 0; i < region.faces.size(); ++i) regions.label[region.faces[i]] = fit.label[i];
  } else {
    grow_faces(work, s, region, g, fit.label, fit.seed, fit.proxy, options.fit.grow, regions);
  }
  if (fit.regions() > 1) relax_borders(work, s, region.source, region.faces, 0, kNone, options.relax, regions);
  return fit.regions();
}

Index split_region(const Work& work, const PatchSurface& s, const Region& region, const SplitOptions& options,
                   Regions& regions) {
  const RegionGraph g =
      make_region_graph(work, s, region, node_size_for(region.faces.size()), options.smooth_normals, regions);
  const std::vector<Index> whole(g.nodes(), 0);
  if (g.nodes() < 2 || spreads(s, region, g, whole, 1, options)[0] <= options.max_spread) return 1;
  ProxyFit fit = fit_proxies(work, g, first_seeds(g, 2, region.source, options), {}, options.fit);
  FitOptions more = options.fit;
  more.max_iterations = std::min(more.max_iterations, 6);
  for (;;) {
    const auto spread = spreads(s, region, g, fit.label, fit.regions(), options);
    std::vector<Index> worst;
    for (Index r = 0; r < fit.regions(); ++r)
      if (spread[r] > options.max_spread) worst.push_back(r);
    if (worst.empty()) break;
    std::stable_sort(worst.begin(), worst.end(), [&](Index a, Index b) { return spread[a] > spread[b]; });
    const std::size_t batch = std::max<std::size_t>(1, fit.regions() >= 8 ? fit.regions() / 4 : 1);
    if (worst.size() > batch) worst.resize(batch);
    const Index before = fit.regions();
    fit = with_more_seeds(work, g, fit, worst, more);
    if (fit.regions() == before) break;
  }
  return write_regions(work, s, region, g, fit, options, regions);
}

}  // namespace

SplitOptions paper_split(std::uint64_t seed) {
  SplitOptions o;
  o.trim = 0;
  o.literal = true;
  o.random_seeds = true;
  o.seed = seed;
  o.smooth_normals = false;
  o.fit.grow.area_in_key = true;
  o.relax.passes = 0;
  return o;
}

PatchLabels split_patches(const Work& work, const PatchSurface& s, const PatchLabels& labels,
                          const SplitOptions& options) {
  Regions regions(labels);
  const Csr faces = faces_of_patches(labels);
  const auto order = largest_first(faces);
  std::vector<Index> count(labels.count, 1);
  for_each(work, Cost::single, order.size(), [&](std::size_t i) {
    const Index p = order[i];
    count[p] = split_region(work, s, {p, 0, faces.row(p)}, options, regions);
  });
  return collect_regions(work, regions, count);
}

Index approximate_region(const Work& work, const PatchSurface& s, const Region& region, Index count,
                         const SplitOptions& options, Regions& regions) {
  const Index node_size =
      count * 8 > region.faces.size() / node_size_for(region.faces.size()) ? 1 : node_size_for(region.faces.size());
  const RegionGraph g = make_region_graph(work, s, region, node_size, options.smooth_normals, regions);
  ProxyFit fit =
      fit_proxies(work, g, first_seeds(g, std::min<Index>(2, count), region.source, options), {}, options.fit);
  while (fit.regions() < std::min(count, g.nodes())) {
    const Index worst = static_cast<Index>(std::max_element(fit.energy.begin(), fit.energy.end()) - fit.energy.begin());
    const Index before = fit.regions();
    fit = with_more_seeds(work, g, fit, std::span(&worst, 1), options.fit);
    if (fit.regions() > before) continue;
    // The worst region is a single node: take the next ones that can be divided.
    std::vector<Index> any;
    for (Index r = 0; r < before && any.empty(); ++r)
      if (worst_node(g, fit, r) != kNone) any.push_back(r);
    if (any.empty()) break;
    fit = with_more_seeds(work, g, fit, any, options.fit);
  }
  return write_regions(work, s, region, g, fit, options, regions);
}

}  // namespace intarsia::kernels
