#include "kernels/quality/patch_border.h"

#include <algorithm>
#include <numeric>

#include "engine/parallel/for_each.h"
#include "engine/parallel/scan.h"
#include "engine/parallel/scratch_pool.h"

namespace intarsia::kernels {

Real PatchBorder::length() const {
  Real sum = 0;
  for (Index l = 0; l < loops(); ++l)
    for (Index i = offset[l]; i < offset[l + 1]; ++i)
      sum += (point[i + 1 == offset[l + 1] ? offset[l] : i + 1] - point[i]).norm();
  return sum;
}

PatchBorder border_of(const SampledLayout& layout, Index patch) {
  PatchBorder border;
  border.offset.push_back(0);
  border.side.push_back(0);
  LoopPoints loop;
  for (const Index l : layout.patch_loops.row(patch)) {
    loop.point.clear(), loop.side.clear();
    append_loop(layout, l, loop);
    const Index base = border.size();
    border.id.insert(border.id.end(), loop.point.begin(), loop.point.end());
    for (std::size_t s = 1; s < loop.side.size(); ++s) border.side.push_back(base + loop.side[s]);
    const auto half_arcs = layout.loop.row(l);
    border.half_arc.insert(border.half_arc.end(), half_arcs.begin(), half_arcs.end());
    border.offset.push_back(border.size());
  }
  border.point.reserve(border.id.size());
  for (const Index i : border.id) border.point.push_back(layout.point[i]);
  return border;
}

PatchMesh triangulate_border(const PatchBorder& border, const LoopsOptions& options, PolygonScratch& scratch) {
  PatchMesh mesh;
  LoopsTriangulation t = triangulate_loops(border.point, border.offset, border.id, options, scratch);
  mesh.triangle = std::move(t.triangle);
  mesh.bridged = border.loops() > 1;
  mesh.failed = !t.ok;
  return mesh;
}

Index Reconstruction::bridged_count() const {
  return static_cast<Index>(std::count(bridged.begin(), bridged.end(), std::uint8_t{1}));
}
Index Reconstruction::failed_count() const {
  return static_cast<Index>(std::count(failed.begin(), failed.end(), std::uint8_t{1}));
}

Reconstruction rebuild(const Work& work, const SampledLayout& layout, const MakePatch& make) {
  const Index patches = layout.patch_count();
  std::vector<PatchBorder> border(patches);
  std::vector<PatchMesh> mesh(patches);
  for_each(work, Cost::heavy, patches, [&](std::size_t p) { border[p] = border_of(layout, static_cast<Index>(p)); });
  std::vector<Index> order(patches);
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return std::pair(border[b].size(), a) < std::pair(border[a].size(), b); });
  auto pool = make_scratch_pool([] { return PolygonScratch(); });
  for_each(work, Cost::single, patches, [&](std::size_t i) {
    const Index p = order[i];
    const auto scratch = pool.borrow();
    if (border[p].loops() > 0)
      mesh[p] = make(p, border[p], *scratch);
    else
      mesh[p].failed = true;
  });

  Reconstruction out;
  out.point = layout.point;
  std::vector<Index> first_inner(patches), first_triangle(patches);
  for (Index p = 0; p < patches; ++p) {
    first_inner[p] = static_cast<Index>(mesh[p].inner.size());
    first_triangle[p] = static_cast<Index>(mesh[p].triangle.size());
    out.bridged.push_back(mesh[p].bridged ? 1 : 0);
    out.failed.push_back(mesh[p].failed ? 1 : 0);
  }
  const Index samples = static_cast<Index>(layout.point.size());
  out.point.resize(samples + exclusive_scan(work, std::span<Index>(first_inner)));
  const Index triangles = exclusive_scan(work, std::span<Index>(first_triangle));
  out.corner.resize(3 * std::size_t{triangles}), out.patch.resize(triangles);
  for_each(work, Cost::heavy, patches, [&](std::size_t p) {
    const Index base = samples + first_inner[p], size = border[p].size();
    for (std::size_t i = 0; i < mesh[p].inner.size(); ++i) out.point.set(base + i, mesh[p].inner[i]);
    for (std::size_t t = 0; t < mesh[p].triangle.size(); ++t) {
      const std::size_t to = first_triangle[p] + t;
      out.patch[to] = static_cast<Index>(p);
      for (std::size_t c = 0; c < 3; ++c) {
        const Index i = mesh[p].triangle[t][c];
        out.corner[3 * to + c] = i < size ? border[p].id[i] : base + (i - size);
      }
    }
  });
  return out;
}

}  // namespace intarsia::kernels
