#include "kernels/quality/patch_border.h"

#include <algorithm>
#include <utility>

#include "engine/parallel/for_each.h"
#include "engine/parallel/scan.h"
#include "engine/space/point_triangle.h"

namespace intarsia::kernels {

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

Index Reconstruction::cut_count() const {
  return static_cast<Index>(std::count(cut.begin(), cut.end(), std::uint8_t{1}));
}

void for_each_patch(const Work& work, const SampledLayout& layout,
                    const std::function<void(Index patch, PatchBorder&& border)>& body) {
  const Index patches = layout.patch_count();
  std::vector<PatchBorder> border(patches);
  for_each(work, Cost::heavy, patches, [&](std::size_t p) { border[p] = border_of(layout, static_cast<Index>(p)); });
  std::vector<Index> order(patches);
  for (Index p = 0; p < patches; ++p) order[p] = p;
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return std::pair(border[b].size(), a) < std::pair(border[a].size(), b); });
  for_each(work, Cost::single, patches, [&](std::size_t i) { body(order[i], std::move(border[order[i]])); });
}

Index Reconstruction::bridged_count() const {
  return static_cast<Index>(std::count(bridged.begin(), bridged.end(), std::uint8_t{1}));
}
Index Reconstruction::failed_count() const {
  return static_cast<Index>(std::count(failed.begin(), failed.end(), std::uint8_t{1}));
}

bool stays_near(std::span<const Vec3> shape, std::span<const Vec3> start, std::span<const Vec3> point,
                const Triangles& triangle, Real reach) {
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (!start.empty() && (shape[i] - start[i]).norm() <= reach) continue;
    const bool near = std::any_of(triangle.begin(), triangle.end(), [&](const auto& t) {
      return (closest_on_triangle(shape[i], point[t[0]], point[t[1]], point[t[2]]) - shape[i]).norm() <= reach;
    });
    if (!near) return false;
  }
  return true;
}

Real diagonal_of(std::span<const Vec3> point) {
  Vec3 low = point[0], high = point[0];
  for (const Vec3& p : point) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).norm();
}

Reconstruction rebuild(const Work& work, const SampledLayout& layout, const MakePatch& make) {
  const Index patches = layout.patch_count();
  std::vector<PatchBorder> border(patches);
  std::vector<PatchMesh> mesh(patches);
  for_each_patch(work, layout, [&](Index p, PatchBorder&& b) {
    if (b.loops() > 0) mesh[p] = make(p, b);
    mesh[p].failed = mesh[p].failed || mesh[p].triangle.empty();
    border[p] = std::move(b);
  });

  Reconstruction out;
  out.point = layout.point;
  std::vector<Index> first_inner(patches), first_triangle(patches);
  for (Index p = 0; p < patches; ++p) {
    first_inner[p] = static_cast<Index>(mesh[p].inner.size());
    first_triangle[p] = static_cast<Index>(mesh[p].triangle.size());
    out.bridged.push_back(border[p].loops() > 1 ? 1 : 0);
    out.failed.push_back(mesh[p].failed ? 1 : 0);
    out.cut.push_back(mesh[p].cut ? 1 : 0);
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
