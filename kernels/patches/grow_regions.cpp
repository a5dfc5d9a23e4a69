#include "kernels/patches/grow_regions.h"

#include <algorithm>
#include <tuple>

namespace intarsia::kernels {
namespace {

struct Entry {
  Real key;
  Index item, label;
};
struct Later {
  bool operator()(const Entry& a, const Entry& b) const {
    return std::tie(a.key, a.item, a.label) > std::tie(b.key, b.item, b.label);
  }
};

class Queue {
 public:
  void push(const Entry& e) { heap_.push_back(e), std::push_heap(heap_.begin(), heap_.end(), Later()); }
  Entry pop() {
    std::pop_heap(heap_.begin(), heap_.end(), Later());
    const Entry e = heap_.back();
    heap_.pop_back();
    return e;
  }
  bool empty() const { return heap_.empty(); }

 private:
  std::vector<Entry> heap_;
};

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
  Queue queue;
  const auto push_around = [&](Index n, Index l) {
    for (const Index o : g.row(n))
      if (label[o] == kNone) {
        const Real d = deviation(g, o, proxy[l]);
        queue.push({options.area_in_key ? d * g.area[o] : d, o, l});
      }
  };
  for (Index l = 0; l < seed.size(); ++l) label[seed[l]] = l;
  for (Index l = 0; l < seed.size(); ++l) push_around(seed[l], l);
  for (Index step = 0; !queue.empty(); ++step) {
    if (step % 4096 == 0) work.check();
    const Entry e = queue.pop();
    if (label[e.item] != kNone) continue;
    label[e.item] = e.label;
    push_around(e.item, e.label);
  }
  return label;
}

void grow_faces(const Work& work, const PatchSurface& s, const Vec3View& normal, const Region& region,
                const RegionGraph& g, std::span<const Index> node_label, std::span<const Index> seed,
                std::span<const Vec3> proxy, const GrowOptions& options, Regions& regions) {
  const auto core = find_cores(g, node_label, seed);
  const std::size_t n = region.faces.size();
  std::vector<Index> label(n);
  for (std::size_t i = 0; i < n; ++i) label[i] = core[g.node_of_face[i]] ? node_label[g.node_of_face[i]] : kNone;
  const auto local = [&](Index f) {
    return f != kNone && regions.is_in(f, region.source, region.label) ? regions.position[f] : kNone;
  };
  Queue queue;
  const auto push_around = [&](Index i) {
    for (int k = 0; k < 3; ++k) {
      const Index o = local(s.neighbour(region.faces[i], k));
      if (o == kNone || label[o] != kNone) continue;
      const Index f = region.faces[o];
      const Real d = 2 - 2 * normal[f].dot(proxy[label[i]]);
      queue.push({options.area_in_key ? d * s.area[f] : d, o, label[i]});
    }
  };
  for (Index i = 0; i < n; ++i)
    if (label[i] != kNone) push_around(i);
  for (Index step = 0; !queue.empty(); ++step) {
    if (step % 4096 == 0) work.check();
    const Entry e = queue.pop();
    if (label[e.item] != kNone) continue;
    label[e.item] = e.label;
    push_around(e.item);
  }
  for (std::size_t i = 0; i < n; ++i) regions.label[region.faces[i]] = label[i];
}

}  // namespace intarsia::kernels
