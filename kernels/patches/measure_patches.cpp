#include "kernels/patches/measure_patches.h"

#include <algorithm>
#include <atomic>

#include "engine/parallel/compact.h"
#include "engine/parallel/union_find.h"

namespace intarsia::kernels {
namespace {

// Adds value(i) to target[row(i)]; runs of equal rows cost one atomic each. Integers only: order cannot show.
template <class T, class Row, class Value>
void add_by_row(const Work& work, std::size_t items, std::vector<T>& target, const Row& row, const Value& value) {
  for_each_block(work, Cost::light, items, [&](std::size_t begin, std::size_t end, std::size_t) {
    Index current = kNone;
    T pending = 0;
    const auto flush = [&] {
      if (current != kNone) std::atomic_ref<T>(target[current]).fetch_add(pending, std::memory_order_relaxed);
    };
    for (std::size_t i = begin; i < end; ++i) {
      const Index r = row(i);
      if (r != current) flush(), current = r, pending = 0;
      pending += value(i);
    }
    flush();
  });
}

// Loops by following each border half-edge to the next one inside the patch: right where a patch touches itself.
void count_loops(const Work& work, const PatchSurface& s, const PatchLabels& labels, std::vector<Index>& loops) {
  const MeshView& mesh = s.mesh;
  const auto& patch = labels.patch_of_face;
  std::vector<std::uint8_t> filled(s.hole.rows());
  for (Index h = 0; h < s.hole.rows(); ++h) filled[h] = patch_of_hole(s, h, patch) != kNone;
  std::vector<Index> filled_edge;
  for (Index h = 0; h < s.hole.rows(); ++h)
    if (filled[h]) filled_edge.insert(filled_edge.end(), s.hole.row(h).begin(), s.hole.row(h).end());
  std::sort(filled_edge.begin(), filled_edge.end());
  const auto crossing = [&](Index e) {
    if (mesh.edge_f1[e] != kNone) return patch[mesh.edge_f0[e]] == patch[mesh.edge_f1[e]];
    return std::binary_search(filled_edge.begin(), filled_edge.end(), e);
  };
  const auto border =
      compact(work, std::size_t{mesh.face_count()} * 3, [&](std::size_t c) { return !crossing(mesh.face_edge[c]); });
  UnionFind sets(border.size());
  for_each(work, Cost::medium, border.size(), [&](std::size_t i) {
    const Index next = next_border(mesh, border[i], crossing, [&](Index e) { return s.before_on_hole(e); });
    const auto at = std::lower_bound(border.begin(), border.end(), next) - border.begin();
    sets.unite(static_cast<Index>(i), static_cast<Index>(at));
  });
  for (std::size_t i = 0; i < border.size(); ++i)
    if (sets.find(static_cast<Index>(i)) == i) ++loops[patch[border[i] / 3]];
}

}  // namespace

Index patch_of_hole(const PatchSurface& s, Index hole, std::span<const Index> patch_of_face) {
  const auto edges = s.hole.row(hole);
  const Index p = patch_of_face[s.mesh.edge_f0[edges[0]]];
  for (const Index e : edges)
    if (patch_of_face[s.mesh.edge_f0[e]] != p) return kNone;
  return p;
}

std::vector<std::int32_t> euler_of_patches(const Work& work, const PatchSurface& s, const PatchLabels& labels) {
  const MeshView& mesh = s.mesh;
  const auto& patch = labels.patch_of_face;
  // Twice V - E + F, with 2 E = 3 F + (edges of faces with nothing of their own patch behind them).
  std::vector<std::int32_t> euler(labels.count, 0);
  std::vector<std::uint8_t> on_border(mesh.vertex_count(), 0);
  add_by_row(
      work, patch.size(), euler, [&](std::size_t f) { return patch[f]; }, [](std::size_t) { return -1; });
  for_each(work, Cost::light, mesh.edge_count(), [&](std::size_t e) {
    const Index f = mesh.edge_f0[e], g = mesh.edge_f1[e];
    if (g != kNone && patch[f] == patch[g]) return;
    std::atomic_ref<std::int32_t>(euler[patch[f]]).fetch_sub(1, std::memory_order_relaxed);
    if (g != kNone) std::atomic_ref<std::int32_t>(euler[patch[g]]).fetch_sub(1, std::memory_order_relaxed);
    for (const Index v : {mesh.edge_v0[e], mesh.edge_v1[e]})
      std::atomic_ref<std::uint8_t>(on_border[v]).store(1, std::memory_order_relaxed);
  });
  // Every fan of faces around a vertex off the borders is whole and of one patch.
  add_by_row(
      work, mesh.vertex_count(), euler,
      [&](std::size_t v) {
        const Index first = mesh.vertex_faces.offset[v];
        return on_border[v] || first == mesh.vertex_faces.offset[v + 1] ? kNone : patch[mesh.vertex_faces.item[first]];
      },
      [](std::size_t) { return 2; });
  for_each_block(work, Cost::light, mesh.vertex_count(), [&](std::size_t begin, std::size_t end, std::size_t) {
    std::vector<Index> around;
    for (std::size_t v = begin; v < end; ++v) {
      if (!on_border[v]) continue;
      around.clear();
      for (const Index f : mesh.vertex_faces.row(static_cast<Index>(v))) around.push_back(patch[f]);
      std::sort(around.begin(), around.end());
      around.erase(std::unique(around.begin(), around.end()), around.end());
      for (const Index p : around) std::atomic_ref<std::int32_t>(euler[p]).fetch_add(2, std::memory_order_relaxed);
    }
  });
  for (std::int32_t& e : euler) e /= 2;
  for (Index h = 0; h < s.hole.rows(); ++h)
    if (const Index p = patch_of_hole(s, h, patch); p != kNone) ++euler[p];
  return euler;
}

PatchTable measure_patches(const Work& work, const PatchSurface& s, const PatchLabels& labels) {
  const MeshView& mesh = s.mesh;
  const auto& patch = labels.patch_of_face;
  PatchTable t;
  t.euler = euler_of_patches(work, s, labels);
  t.faces.assign(labels.count, 0), t.loops.assign(labels.count, 0), t.filled_holes.assign(labels.count, 0);
  t.area.assign(labels.count, 0), t.perimeter.assign(labels.count, 0);
  t.normal_sum.resize(labels.count);
  // Sums of floats go through one fixed order; a linear pass is faster here than sorting faces by patch.
  for (Index f = 0; f < patch.size(); ++f) {
    if (f % 4096 == 0) work.check();
    const Index p = patch[f];
    ++t.faces[p];
    t.area[p] += s.area[f];
    t.normal_sum.set(p, t.normal_sum[p] + s.area[f] * s.normal[f]);
  }
  const auto borders = compact(work, mesh.edge_count(), [&](std::size_t e) {
    return mesh.edge_f1[e] == kNone || patch[mesh.edge_f0[e]] != patch[mesh.edge_f1[e]];
  });
  for (const Index e : borders) {
    const Real length = s.edge_length(e);
    t.perimeter[patch[mesh.edge_f0[e]]] += length;
    if (mesh.edge_f1[e] != kNone) t.perimeter[patch[mesh.edge_f1[e]]] += length;
  }
  for (Index h = 0; h < s.hole.rows(); ++h)
    if (const Index p = patch_of_hole(s, h, patch); p != kNone) ++t.filled_holes[p];
  count_loops(work, s, labels, t.loops);
  return t;
}

}  // namespace intarsia::kernels
