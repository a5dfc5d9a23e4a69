#include "kernels/patches/grow_regions.h"

#include <algorithm>

#include "engine/parallel/compact.h"
#include "kernels/patches/least_first.h"

namespace intarsia::kernels {
namespace {

// Nodes that keep their label: joined to the seed of their region through nodes that touch no other region.
std::vector<std::uint8_t> find_cores(const RegionGraph& g, std::span<const Index> label, std::span<const Index> seed) {
  std::vector<std::uint8_t> core(g.nodes(), 0);
  std::vector<Index> stack;
  for (const Index s : seed) {
    core[s] = 1;
    stack.push_back(s);
    while (!stack.empty()) {
      const Index n = stack.back();
      stack.pop_back();
      for (const Index o : g.row(n)) {
        if (core[o] || label[o] != label[s]) continue;
        const auto row = g.row(o);
        if (std::any_of(row.begin(), row.end(), [&](Index x) { return label[x] != label[s]; })) continue;
        core[o] = 1;
        stack.push_back(o);
      }
    }
  }
  return core;
}

}  // namespace

Real deviation(const RegionGraph& g, Index node, const Vec3& proxy) { return 2 - 2 * g.mean_normal[node].dot(proxy); }

std::vector<Index> grow_regions(const Work& work, const RegionGraph& g, std::span<const Index> seed,
                                std::span<const Vec3> proxy, const GrowOptions& options) {
  std::vector<Index> label(g.nodes(), kNone);
  LeastFirst queue;  // deviation, node, region
  const auto push_around = [&](Index n, Index l) {
    for (const Index o : g.row(n))
      if (label[o] == kNone) {
        const Real d = deviation(g, o, proxy[l]);
        queue.push(options.area_in_key ? d * g.area[o] : d, o, l);
      }
  };
  for (Index l = 0; l < seed.size(); ++l) label[seed[l]] = l;
  for (Index l = 0; l < seed.size(); ++l) push_around(seed[l], l);
  for (Index step = 0; !queue.empty(); ++step) {
    if (step % 4096 == 0) work.check();
    const auto e = queue.pop();
    if (label[e.first()] != kNone) continue;
    label[e.first()] = e.second();
    push_around(e.first(), e.second());
  }
  return label;
}

void grow_faces(const Work& work, const PatchSurface& s, const FaceVectors& normal, const Region& region,
                const RegionGraph& g, std::span<const Index> node_label, std::span<const Index> seed,
                std::span<const Vec3> proxy, const GrowOptions& options, Regions& regions) {
  const auto core = find_cores(g, node_label, seed);
  const std::size_t n = region.faces.size();
  std::vector<Index> label(n);
  for_each(work, Cost::light, n,
           [&](std::size_t i) { label[i] = core[g.node_of_face[i]] ? node_label[g.node_of_face[i]] : kNone; });
  const auto local = [&](Index f) {
    return f != kNone && regions.is_in(f, region.source, region.label) ? regions.position[f] : kNone;
  };
  LeastFirst queue;  // deviation, face, region
  const auto push_around = [&](Index i) {
    for (int k = 0; k < 3; ++k) {
      const Index o = local(s.neighbour(region.faces[i], k));
      if (o == kNone || label[o] != kNone) continue;
      const Index f = region.faces[o];
      const Real d = 2 - 2 * normal[f].dot(proxy[label[i]]);
      queue.push(options.area_in_key ? d * s.area[f] : d, o, label[i]);
    }
  };
  const std::vector<Index> rim = compact(work, n, [&](std::size_t i) {
    if (label[i] == kNone) return false;
    for (int k = 0; k < 3; ++k)
      if (const Index o = local(s.neighbour(region.faces[i], k)); o != kNone && label[o] == kNone) return true;
    return false;
  });
  for (const Index i : rim) push_around(i);
  for (Index step = 0; !queue.empty(); ++step) {
    if (step % 4096 == 0) work.check();
    const auto e = queue.pop();
    if (label[e.first()] != kNone) continue;
    label[e.first()] = e.second();
    push_around(e.first());
  }
  for_each(work, Cost::light, n, [&](std::size_t i) { regions.label[region.faces[i]] = label[i]; });
}

}  // namespace intarsia::kernels
