#include "kernels/patches/flood_patches.h"

#include <atomic>

#include "engine/parallel/compact.h"
#include "engine/parallel/reduce.h"
#include "engine/parallel/union_find.h"

namespace intarsia::kernels {
namespace {

template <class Joined>
PatchLabels flood(const Work& work, const MeshView& mesh, const Joined& joined) {
  const Index faces = mesh.face_count();
  UnionFind sets(faces);
  for_each(work, Cost::light, mesh.edge_count(), [&](std::size_t e) {
    if (mesh.edge_f1[e] != kNone && joined(static_cast<Index>(e))) sets.unite(mesh.edge_f0[e], mesh.edge_f1[e]);
  });
  PatchLabels labels;
  labels.patch_of_face.resize(faces);
  for_each(work, Cost::light, faces,
           [&](std::size_t f) { labels.patch_of_face[f] = sets.find(static_cast<Index>(f)); });
  return compact_labels(work, labels.patch_of_face, faces);
}

}  // namespace

PatchLabels compact_labels(const Work& work, std::span<const Index> id, Index bound) {
  std::vector<Index> rank(bound, kNone);  // first the smallest face of each id, then its rank
  for_each_block(work, Cost::light, id.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t f = begin; f < end; ++f) {
      if (f > begin && id[f] == id[f - 1]) continue;
      std::atomic_ref<Index> first(rank[id[f]]);
      Index seen = first.load(std::memory_order_relaxed);
      while (f < seen && !first.compare_exchange_weak(seen, static_cast<Index>(f), std::memory_order_relaxed)) {
      }
    }
  });
  const auto firsts = compact(work, id.size(), [&](std::size_t f) { return rank[id[f]] == f; });
  PatchLabels labels;
  labels.count = static_cast<Index>(firsts.size());
  for_each(work, Cost::light, firsts.size(), [&](std::size_t r) { rank[id[firsts[r]]] = static_cast<Index>(r); });
  labels.patch_of_face.resize(id.size());
  for_each(work, Cost::light, id.size(), [&](std::size_t f) { labels.patch_of_face[f] = rank[id[f]]; });
  return labels;
}

PatchLabels flood_patches(const Work& work, const MeshView& mesh, std::span<const std::uint8_t> on_network) {
  return flood(work, mesh, [&](Index e) { return !on_network[e]; });
}

PatchLabels flood_equal(const Work& work, const MeshView& mesh, std::span<const Index> id) {
  return flood(work, mesh, [&](Index e) { return id[mesh.edge_f0[e]] == id[mesh.edge_f1[e]]; });
}

Index clear_dangling(const Work& work, const MeshView& mesh, const PatchLabels& labels,
                     std::span<std::uint8_t> on_network) {
  const auto& patch = labels.patch_of_face;
  return reduce(
      work, Cost::light, mesh.edge_count(), Index{0},
      [&](std::size_t begin, std::size_t end) {
        Index cleared = 0;
        for (std::size_t e = begin; e < end; ++e)
          if (on_network[e] && mesh.edge_f1[e] != kNone && patch[mesh.edge_f0[e]] == patch[mesh.edge_f1[e]]) {
            on_network[e] = 0;
            ++cleared;
          }
        return cleared;
      },
      [](Index a, Index b) { return a + b; });
}

}  // namespace intarsia::kernels
