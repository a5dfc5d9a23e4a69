#include "kernels/patches/region_fit.h"

#include <algorithm>

namespace intarsia::kernels {
namespace {

constexpr Index kFitAll = 8;      // regions up to which all are fitted again for each new seed
constexpr int kAttempts = 16;     // seeds tried for one region
constexpr Index kFitAround = 64;  // regions up to which the neighbours of the worst one are

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

}  // namespace

RegionFit::RegionFit(const Work& work, const RegionGraph& graph, std::vector<Index> seed, const ProxyOptions& options)
    : graph_(&graph),
      fit_(fit_proxies(work, graph, std::move(seed), {}, options)),
      odd_(graph.nodes(), 0),
      rank_(graph.nodes(), kNone) {
  collect_members();
}

void RegionFit::collect_members() {
  members_.assign(fit_.regions(), {});
  for (Index n = 0; n < fit_.label.size(); ++n) members_[fit_.label[n]].push_back(n);
}

// The node of a region that fits its proxy worst, not its seed, not an odd one. Ties: smaller id.
Index RegionFit::worst_node(Index r) const {
  Index worst = kNone;
  Real most = 0;
  for (const Index n : members_[r])
    if (n != fit_.seed[r] && graph_->area[n] > 0 && !odd_[n])
      if (const Real d = deviation(*graph_, n, fit_.proxy[r]); worst == kNone || d > most) most = d, worst = n;
  return worst;
}

bool RegionFit::add_everywhere(const Work& work, Index r, Index node, const ProxyOptions& options) {
  std::vector<Index> seed = fit_.seed;
  std::vector<Vec3> proxy = fit_.proxy;
  seed.push_back(node), proxy.push_back(graph_->mean_normal[node].normalized());
  ProxyFit fit = fit_proxies(work, *graph_, std::move(seed), std::move(proxy), options);
  if (fit.area.back() < options.least_share * fit_.area[r]) return false;
  fit_ = std::move(fit);
  collect_members();
  return true;
}

bool RegionFit::add_seed_everywhere(const Work& work, Index r, const ProxyOptions& options) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const Index node = worst_node(r);
    if (node == kNone) return false;
    if (add_everywhere(work, r, node, options)) return true;
    odd_[node] = 1;
  }
  return false;
}

std::vector<Index> RegionFit::add_seed(const Work& work, Index r, const ProxyOptions& options) {
  const Index count = regions();
  std::vector<Index> changed;
  if (count < kFitAll || (count <= kFitAround && (count & (count - 1)) == 0)) {
    if (!add_seed_everywhere(work, r, options)) return changed;
    for (Index i = 0; i < regions(); ++i) changed.push_back(i);
    return changed;
  }
  for (int attempt = 0; changed.empty() && attempt < kAttempts; ++attempt) {
    const Index node = worst_node(r);
    if (node == kNone) break;
    changed = add_locally(work, r, node, count <= kFitAround, options);
    if (changed.empty()) odd_[node] = 1;
  }
  return changed;
}

// Empty, and nothing changed, if the new region is too small.
std::vector<Index> RegionFit::add_locally(const Work& work, Index r, Index node, bool around,
                                          const ProxyOptions& options) {
  std::vector<Index> changed{r}, nodes;
  if (around)
    for (const Index n : members_[r])
      for (const Index o : graph_->row(n)) changed.push_back(fit_.label[o]);
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const Index c : changed) nodes.insert(nodes.end(), members_[c].begin(), members_[c].end());
  std::sort(nodes.begin(), nodes.end());
  const RegionGraph sub = induced(*graph_, nodes, rank_);
  std::vector<Index> seeds;
  std::vector<Vec3> proxies;
  for (const Index c : changed) seeds.push_back(rank_[fit_.seed[c]]), proxies.push_back(fit_.proxy[c]);
  seeds.push_back(rank_[node]), proxies.push_back(graph_->mean_normal[node].normalized());
  for (const Index n : nodes) rank_[n] = kNone;
  const ProxyFit part = fit_proxies(work, sub, std::move(seeds), std::move(proxies), options);
  if (part.area.back() < options.least_share * fit_.area[r]) return {};
  changed.push_back(fit_.regions());
  fit_.seed.push_back(kNone), fit_.proxy.push_back({}), fit_.area.push_back(0), fit_.energy.push_back(0);
  members_.emplace_back();
  for (Index i = 0; i < changed.size(); ++i) {
    const Index c = changed[i];
    fit_.seed[c] = nodes[part.seed[i]], fit_.proxy[c] = part.proxy[i];
    fit_.area[c] = part.area[i], fit_.energy[c] = part.energy[i];
    members_[c].clear();
  }
  for (Index i = 0; i < nodes.size(); ++i) {
    fit_.label[nodes[i]] = changed[part.label[i]];
    members_[changed[part.label[i]]].push_back(nodes[i]);
  }
  return changed;
}

void RegionFit::write(const Work& work, const PatchSurface& s, const FaceVectors& normal, const Region& region,
                      const GrowOptions& grow, const RelaxOptions& relax, Regions& regions) const {
  for (const Index f : region.faces) regions.label[f] = region.label;
  if (graph_->is_faces) {
    for (std::size_t i = 0; i < region.faces.size(); ++i) regions.label[region.faces[i]] = fit_.label[i];
  } else {
    grow_faces(work, s, normal, region, *graph_, fit_.label, fit_.seed, fit_.proxy, grow, regions);
  }
  if (fit_.regions() > 1) relax_borders(work, s, region.source, region.faces, 0, kNone, relax, regions);
}

}  // namespace intarsia::kernels
