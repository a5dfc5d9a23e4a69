#include "kernels/patches/split_patches.h"

#include <algorithm>
#include <numeric>

#include "engine/base/random.h"
#include "engine/parallel/for_each.h"
#include "kernels/patches/normal_spread.h"
#include "kernels/patches/region_fit.h"

namespace intarsia::kernels {
namespace {

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

Index split_region(const Work& work, const PatchSurface& s, const FaceVectors& normal, const Region& region,
                   const SplitOptions& options, Regions& regions) {
  const RegionGraph g = make_region_graph(work, s, region, node_size_for(region.faces.size()), normal, regions);
  const Csr faces_of_node = faces_of_patches({g.node_of_face, g.nodes()});
  std::vector<Index> whole(g.nodes());
  std::iota(whole.begin(), whole.end(), Index{0});
  if (g.nodes() < 2 || spread_of(s, region, g, faces_of_node, whole, options) <= options.max_spread) return 1;
  RegionFit fit(work, g, first_seeds(g, 2, region.source, options), options.fit);
  const auto measure = [&](Index r) { return spread_of(s, region, g, faces_of_node, fit.members(r), options); };
  ProxyOptions more = options.fit;
  more.max_iterations = std::min(more.max_iterations, 6);
  std::vector<Index> changed(fit.regions());
  std::iota(changed.begin(), changed.end(), Index{0});
  std::vector<Real> spread;
  while (!changed.empty()) {
    spread.resize(fit.regions());
    for (const Index r : changed) spread[r] = measure(r);
    Index worst = kNone;
    for (Index r = 0; r < fit.regions(); ++r)
      if (spread[r] > options.max_spread && fit.fit().area[r] >= options.least_area * s.total_area &&
          fit.members(r).size() > 1 && (worst == kNone || spread[r] > spread[worst]))
        worst = r;
    if (worst == kNone) break;
    changed = fit.add_seed(work, worst, more);
  }
  fit.write(work, s, normal, region, options.fit.grow, options.relax, regions);
  return fit.regions();
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
  const SmoothNormals normal = smooth_normals(work, s, labels.patch_of_face, options.smoothing);
  const Csr faces = faces_of_patches(labels);
  const auto order = largest_first(faces);
  std::vector<Index> count(labels.count, 1);
  for_each(work, Cost::single, order.size(), [&](std::size_t i) {
    const Index p = order[i];
    if (s.is_locked(faces.row(p)[0])) return;
    count[p] = split_region(work, s, normal, {p, 0, faces.row(p)}, options, regions);
  });
  return collect_regions(work, regions, count);
}

Index approximate_region(const Work& work, const PatchSurface& s, const FaceVectors& normal, const Region& region,
                         Index count, const SplitOptions& options, Regions& regions) {
  const Index node_size =
      count * 8 > region.faces.size() / node_size_for(region.faces.size()) ? 1 : node_size_for(region.faces.size());
  const RegionGraph g = make_region_graph(work, s, region, node_size, normal, regions);
  RegionFit fit(work, g, first_seeds(g, std::min<Index>(2, count), region.source, options), options.fit);
  while (fit.regions() < std::min(count, g.nodes())) {
    Index worst = kNone;
    for (Index r = 0; r < fit.regions(); ++r)
      if (fit.can_divide(r) && (worst == kNone || fit.fit().energy[r] > fit.fit().energy[worst])) worst = r;
    if (worst == kNone || !fit.add_seed_everywhere(work, worst, options.fit)) break;
  }
  fit.write(work, s, normal, region, options.fit.grow, options.relax, regions);
  return fit.regions();
}

}  // namespace intarsia::kernels
