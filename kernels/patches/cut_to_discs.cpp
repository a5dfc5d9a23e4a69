#include "kernels/patches/cut_to_discs.h"

#include <algorithm>

#include "engine/parallel/for_each.h"
#include "kernels/patches/grow_regions.h"
#include "kernels/patches/measure_patches.h"
#include "kernels/patches/region_graph.h"

namespace intarsia::kernels {
namespace {

struct Part {
  Index label;
  std::vector<Index> faces;
};

// Returns the number of labels used in the source.
Index cut_source(const Work& work, const PatchSurface& s, const Region& whole, int whole_euler,
                 const DiscOptions& options, Regions& regions) {
  Index labels = 1;
  std::vector<Part> open;
  open.push_back({0, {whole.faces.begin(), whole.faces.end()}});
  while (!open.empty()) {
    const Part part = std::move(open.back());
    open.pop_back();
    const Region region{whole.source, part.label, part.faces};
    const int euler = part.faces.size() == whole.faces.size() ? whole_euler : euler_of_region(s, region, regions);
    if (euler == 1 || part.faces.size() < 2) continue;
    const Index defect = static_cast<Index>(std::abs(1 - euler));
    const Index k = std::min(options.most_seeds, 2 + 2 * std::min(defect, options.most_seeds));
    const Index first_new = labels;
    const Index parts = divide_region(work, s, region, k, first_new, options.relax, regions);
    labels += parts - 1;
    std::vector<Part> pieces(parts);
    for (Index i = 0; i < parts; ++i) pieces[i].label = i == 0 ? part.label : first_new + i - 1;
    for (const Index f : part.faces) {
      const Index l = regions.label[f];
      pieces[l == part.label ? 0 : l - first_new + 1].faces.push_back(f);
    }
    for (auto it = pieces.rbegin(); it != pieces.rend(); ++it) open.push_back(std::move(*it));
  }
  return labels;
}

}  // namespace

int euler_of_region(const PatchSurface& s, const Region& region, const Regions& regions) {
  int euler = 0;
  for (const Index f : region.faces)
    euler += euler_share(s.mesh, f, [&](Index g) { return regions.is_in(g, region.source, region.label); });
  for (Index h = 0; h < s.hole.rows(); ++h) {
    const auto edges = s.hole.row(h);
    if (std::all_of(edges.begin(), edges.end(),
                    [&](Index e) { return regions.is_in(s.mesh.edge_f0[e], region.source, region.label); }))
      ++euler;
  }
  return euler;
}

Index divide_region(const Work& work, const PatchSurface& s, const Region& region, Index k, Index first_new,
                    const RelaxOptions& relax, Regions& regions) {
  const std::size_t faces = region.faces.size();
  Index node_size = node_size_for(faces);
  if (faces / node_size < std::size_t{k} * 8) node_size = 1;
  RegionGraph g = make_region_graph(work, s, region, node_size, s.normal, regions);
  FarSeeds far = farthest_seeds(work, g, k);
  if (!g.is_faces && far.seed.size() > 1) {
    std::vector<Index> face_of_seed(far.seed.size(), kNone), seed_of_node(g.nodes(), kNone);
    for (Index i = 0; i < far.seed.size(); ++i) seed_of_node[far.seed[i]] = i;
    for (Index i = 0; i < faces; ++i) {
      const Index seed = seed_of_node[g.node_of_face[i]];
      if (seed != kNone && face_of_seed[seed] == kNone) face_of_seed[seed] = i;
    }
    g = make_region_graph(work, s, region, 1, s.normal, regions);
    far = {face_of_seed, nearest_seed(work, g, face_of_seed)};
  } else if (!g.is_faces) {
    g = make_region_graph(work, s, region, 1, s.normal, regions);
  }
  if (far.seed.size() < 2 && faces > 1) {  // all faces in one place: any two connected parts will do
    far.seed = {0, static_cast<Index>(faces - 1)};
    const std::vector<Vec3> none(2, Vec3::Zero());
    far.label = grow_regions(work, g, far.seed, none, {});
  }
  for (std::size_t i = 0; i < faces; ++i) {
    const Index l = far.label[i];
    if (l != 0 && l != kNone) regions.label[region.faces[i]] = first_new + l - 1;
  }
  relax_borders(work, s, region.source, region.faces, first_new, region.label, relax, regions);
  return static_cast<Index>(far.seed.size());
}

PatchLabels cut_to_discs(const Work& work, const PatchSurface& s, const PatchLabels& labels,
                         const DiscOptions& options) {
  const auto euler = euler_of_patches(work, s, labels);
  if (std::all_of(euler.begin(), euler.end(), [](int e) { return e == 1; })) return labels;
  Regions regions(labels);
  const Csr faces = faces_of_patches(labels);
  std::vector<Index> order = largest_first(faces);
  std::erase_if(order, [&](Index p) { return euler[p] == 1 || s.is_locked(faces.row(p)[0]); });
  std::vector<Index> count(labels.count, 1);
  for_each(work, Cost::single, order.size(), [&](std::size_t i) {
    const Index p = order[i];
    count[p] = cut_source(work, s, {p, 0, faces.row(p)}, euler[p], options, regions);
  });
  const PatchLabels parts = collect_regions(work, regions, count);
  PatchGraph graph(work, s, parts);
  const auto source = [&](Index p) { return labels.patch_of_face[graph[p].first_face]; };
  merge_cheapest(
      work, options.merge, 1,
      [&](Index p, const Border& b) { return source(p) == source(b.other) && graph.union_euler(p, b) == 1; }, graph);
  return graph.labels(work, parts);
}

}  // namespace intarsia::kernels
