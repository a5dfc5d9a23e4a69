#include "kernels/network/snap_curves.h"

#include <vector>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {
namespace {

SurfacePoint snapped(const MeshView& mesh, std::span<const std::uint8_t> on_sharp, Real snap, const SurfacePoint& p) {
  if (p.kind != PointKind::edge) return p;
  const Index a = mesh.edge_v0[p.element], b = mesh.edge_v1[p.element];
  if (!on_sharp.empty() && on_sharp[a] != on_sharp[b]) return SurfacePoint::at_vertex(on_sharp[a] ? a : b);
  if (p.a <= snap && (p.a < 0.5 || a < b)) return SurfacePoint::at_vertex(a);
  if (p.a >= 1 - snap) return SurfacePoint::at_vertex(b);
  return p;
}

}  // namespace

void snap_curves(const Work& work, const MeshView& mesh, std::span<const std::uint8_t> on_sharp,
                 const SnapOptions& options, CurveNetwork& curves) {
  for_each(work, Cost::light, curves.point.size(),
           [&](std::size_t i) { curves.point[i] = snapped(mesh, on_sharp, options.snap, curves.point[i]); });
  Csr kept;
  kept.offset.push_back(0);
  std::vector<Index> row;
  const auto same = [&](Index i, Index j) { return curves.point[i] == curves.point[j]; };
  for (Index c = 0; c < curves.curve_count(); ++c) {
    row.clear();
    for (Index i : curves.curve.row(c)) {
      if (!row.empty() && same(row.back(), i)) continue;
      if (row.size() >= 2 && same(row[row.size() - 2], i)) {
        row.pop_back();
        continue;
      }
      row.push_back(i);
    }
    if (row.size() > 1) kept.item.insert(kept.item.end(), row.begin(), row.end());
    kept.offset.push_back(static_cast<Index>(kept.item.size()));
  }
  curves.curve = std::move(kept);
}

}  // namespace intarsia::kernels
