#include "kernels/patches/split_patches.h"

#include <algorithm>

#include "engine/base/random.h"
#include "engine/parallel/for_each.h"
#include "kernels/patches/normal_spread.h"

namespace intarsia::kernels {
namespace {

using Members = std::vector<std::vector<Index>>;  // region -> its nodes, ascending

Members members_of(std::span<const Index> label, Index regions) {
  Members members(regions);
  for (Index n = 0; n < label.size(); ++n) members[label[n]].push_back(n);
  return members;
}

// Spread of the normals of some nodes. With the literal rule each face speaks, otherwise each node.
Real spread_of(const PatchSurface& s, const Region& region, const RegionGraph& g, const Csr& faces_of_node,
               std::span<const Index> nodes, const SplitOptions& options) {
  std::vector<WeightedNormal> normals;
  for (const Index n : nodes) {
    if (options.literal) {
      for (const Index i : faces_of_node.row(n)) {
        const Index f = region.faces[i];
        normals.push_back({s.area[f] > 0 ? s.normal[f] : Vec3::Zero(), s.area[f]});
      }
    } else {
      const Vec3 sum = g.normal_sum[n];
      const Real length = sum.norm();
      normals.push_back({length > 0 ? Vec3(sum / length) : Vec3::Zero(), g.area[n]});
    }
  }
  return options.literal ? max_pair_angle(normals, options.max_spread) : trimmed_spread(normals, options.trim);
}

// The node of a region that fits its proxy worst, not its seed. Ties: smaller id.
Index worst_node(const RegionGraph& g, const ProxyFit& fit, Index r, std::span<const Index> nodes) {
  Index worst = kNone;
  Real most = 0;
  for (const Index n : nodes)
    if (n != fit.seed[r] && g.area[n] > 0)
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

// Adds a seed in region r and fits all regions again, from the proxies they have. False if r cannot be divided.
bool add_seed(const Work& work, const RegionGraph& g, Index r, const ProxyOptions& options, Members& members,
              ProxyFit& fit) {
  const Index n = worst_node(g, fit, r, members[r]);
  if (n == kNone) return false;
  std::vector<Index> seed = fit.seed;
  std::vector<Vec3> proxy = fit.proxy;
  seed.push_back(n), proxy.push_back(g.mean_normal[n].normalized());
  fit = fit_proxies(work, g, std::move(seed), std::move(proxy), options);
  members = members_of(fit.label, fit.regions());
  return true;
}

Index write_regions(const Work& work, const PatchSurface& s, const Vec3View& normal, const Region& region,
                    const RegionGraph& g, const ProxyFit& fit, const SplitOptions& options, Regions& regions) {
  if (g.is_faces) {
    for (std::size_t i = 0; i < region.faces.size(); ++i) regions.label[region.faces[i]] = fit.label[i];
  } else {
    grow_faces(work, s, normal, region, g, fit.label, fit.seed, fit.proxy, options.fit.grow, regions);
  }
  if (fit.regions() > 1) relax_borders(work, s, region.source, region.faces, 0, kNone, options.relax, regions);
  return fit.regions();
}

// The graph of some nodes alone. rank must hold kNone everywhere; afterwards it holds the place of each node.
RegionGraph induced(const RegionGraph& g, std::span<const Index> nodes, std::vector<Index>& rank) {
  RegionGraph sub;
  const Index count = static_cast<Index>(nodes.size());
  sub.area.resize(count);
  sub.normal_sum.resize(count), sub.mean_normal.resize(count), sub.centroid.resize(count);
  for (Index i = 0; i < count; ++i) {
    rank[nodes[i]] = i;
    sub.area[i] = g.area[nodes[i]];
    sub.normal_sum.set(i, g.normal_sum[nodes[i]]);
    sub.mean_normal.set(i, g.mean_normal[nodes[i]]);
    sub.centroid.set(i, g.centroid[nodes[i]]);
  }
  sub.offset.assign(1, 0);
  for (const Index n : nodes) {
    for (const Index o : g.row(n))
      if (rank[o] != kNone) sub.other.push_back(rank[o]);
    sub.offset.push_back(static_cast<Index>(sub.other.size()));
  }
  return sub;
}

// One more seed in region r, after which only r, and with `around` its neighbours, are fitted again: with many regions
// a full round for each seed would make the whole quadratic. Returns the regions that changed, the new one last; empty
// if r cannot be divided.
std::vector<Index> add_seed_locally(const Work& work, const RegionGraph& g, Index r, bool around,
                                    const ProxyOptions& options, std::vector<Index>& rank, Members& members,
                                    ProxyFit& fit) {
  const Index seed = worst_node(g, fit, r, members[r]);
  if (seed == kNone) return {};
  std::vector<Index> changed{r}, nodes;
  if (around)
    for (const Index n : members[r])
      for (const Index o : g.row(n)) changed.push_back(fit.label[o]);
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const Index c : changed) nodes.insert(nodes.end(), members[c].begin(), members[c].end());
  std::sort(nodes.begin(), nodes.end());
  const RegionGraph sub = induced(g, nodes, rank);
  std::vector<Index> seeds;
  std::vector<Vec3> proxies;
  for (const Index c : changed) seeds.push_back(rank[fit.seed[c]]), proxies.push_back(fit.proxy[c]);
  seeds.push_back(rank[seed]), proxies.push_back(g.mean_normal[seed].normalized());
  for (const Index n : nodes) rank[n] = kNone;
  const ProxyFit part = fit_proxies(work, sub, std::move(seeds), std::move(proxies), options);
  changed.push_back(fit.regions());
  fit.seed.push_back(kNone), fit.proxy.push_back({}), fit.area.push_back(0), fit.energy.push_back(0);
  members.emplace_back();
  for (Index i = 0; i < changed.size(); ++i) {
    const Index c = changed[i];
    fit.seed[c] = nodes[part.seed[i]], fit.proxy[c] = part.proxy[i];
    fit.area[c] = part.area[i], fit.energy[c] = part.energy[i];
    members[c].clear();
  }
  for (Index i = 0; i < nodes.size(); ++i) {
    fit.label[nodes[i]] = changed[part.label[i]];
    members[changed[part.label[i]]].push_back(nodes[i]);
  }
  return changed;
}

constexpr Index kFitAll = 8;      // regions up to which all are fitted again for each new seed
constexpr Index kFitAround = 64;  // regions up to which the neighbours of the worst one are

Index split_region(const Work& work, const PatchSurface& s, const Vec3View& normal, const Region& region,
                   const SplitOptions& options, Regions& regions) {
  const RegionGraph g = make_region_graph(work, s, region, node_size_for(region.faces.size()), normal, regions);
  const Csr faces_of_node = faces_of_patches({g.node_of_face, g.nodes()});
  const std::vector<Index> whole(g.nodes(), 0);
  Members members = members_of(whole, 1);
  const auto measure = [&](Index r) { return spread_of(s, region, g, faces_of_node, members[r], options); };
  if (g.nodes() < 2 || measure(0) <= options.max_spread) return 1;
  ProxyFit fit = fit_proxies(work, g, first_seeds(g, 2, region.source, options), {}, options.fit);
  members = members_of(fit.label, fit.regions());
  ProxyOptions more = options.fit;
  more.max_iterations = std::min(more.max_iterations, 6);
  std::vector<Index> rank(g.nodes(), kNone), changed;
  std::vector<Real> spread;
  for (;;) {
    const Index count = fit.regions();
    spread.resize(count);
    if (changed.empty())
      for (Index r = 0; r < count; ++r) spread[r] = measure(r);
    for (const Index r : changed) spread[r] = measure(r);
    Index worst = kNone;
    for (Index r = 0; r < count; ++r)
      if (spread[r] > options.max_spread && fit.area[r] >= options.least_area * s.total_area && members[r].size() > 1 &&
          (worst == kNone || spread[r] > spread[worst]))
        worst = r;
    if (worst == kNone) break;
    if (count < kFitAll || (count <= kFitAround && (count & (count - 1)) == 0)) {
      changed.clear();
      if (!add_seed(work, g, worst, more, members, fit)) break;
    } else {
      changed = add_seed_locally(work, g, worst, count <= kFitAround, more, rank, members, fit);
      if (changed.empty()) break;
    }
  }
  return write_regions(work, s, normal, region, g, fit, options, regions);
}

}  // namespace

SplitOptions paper_split(std::uint64_t seed) {
  SplitOptions o;
  o.trim = 0, o.least_area = 0;
  o.literal = true;
  o.random_seeds = true;
  o.seed = seed;
  o.smoothing = 0;
  o.fit.grow.area_in_key = true;
  o.relax.passes = 0;
  return o;
}

PatchLabels split_patches(const Work& work, const PatchSurface& s, const PatchLabels& labels,
                          const SplitOptions& options) {
  Regions regions(labels);
  const Vec3Array normal = smooth_normals(work, s, labels.patch_of_face, options.smoothing);
  const Csr faces = faces_of_patches(labels);
  const auto order = largest_first(faces);
  std::vector<Index> count(labels.count, 1);
  for_each(work, Cost::single, order.size(), [&](std::size_t i) {
    const Index p = order[i];
    count[p] = split_region(work, s, normal, {p, 0, faces.row(p)}, options, regions);
  });
  return collect_regions(work, regions, count);
}

Index approximate_region(const Work& work, const PatchSurface& s, const Vec3View& normal, const Region& region,
                         Index count, const SplitOptions& options, Regions& regions) {
  const Index node_size =
      count * 8 > region.faces.size() / node_size_for(region.faces.size()) ? 1 : node_size_for(region.faces.size());
  const RegionGraph g = make_region_graph(work, s, region, node_size, normal, regions);
  ProxyFit fit =
      fit_proxies(work, g, first_seeds(g, std::min<Index>(2, count), region.source, options), {}, options.fit);
  Members members = members_of(fit.label, fit.regions());
  while (fit.regions() < std::min(count, g.nodes())) {
    Index worst = kNone;
    for (Index r = 0; r < fit.regions(); ++r)
      if (worst_node(g, fit, r, members[r]) != kNone && (worst == kNone || fit.energy[r] > fit.energy[worst]))
        worst = r;
    if (worst == kNone || !add_seed(work, g, worst, options.fit, members, fit)) break;
  }
  return write_regions(work, s, normal, region, g, fit, options, regions);
}

}  // namespace intarsia::kernels
