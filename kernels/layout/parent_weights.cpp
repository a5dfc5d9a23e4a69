#include "kernels/layout/parent_weights.h"

#include <array>
#include <numeric>

#include "engine/parallel/build_csr.h"
#include "engine/parallel/reduce.h"
#include "engine/space/surface_path.h"

namespace intarsia::kernels {

bool is_uncut(const MeshView& original, const RefinedMesh& refined, Index f) {
  const Index parent = refined.parent[f];
  if (parent >= original.face_count()) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Index v = refined.mesh.corner[3 * std::size_t{f} + i];
    if (v != original.corner[3 * std::size_t{parent} + i]) return false;
    const SurfacePoint& p = refined.origin[v];
    if (p.kind != PointKind::vertex || p.element != v) return false;
  }
  return true;
}

std::optional<Real> share_of_parent(const MeshView& original, const RefinedMesh& refined, Index f) {
  if (is_uncut(original, refined, f)) return 1;
  const Index parent = refined.parent[f];
  if (parent >= original.face_count()) return std::nullopt;
  std::array<std::array<Real, 3>, 3> w;
  for (std::size_t i = 0; i < 3; ++i) {
    const SurfacePoint& p = refined.origin[refined.mesh.corner[3 * std::size_t{f} + i]];
    const Index limit = p.kind == PointKind::vertex ? original.vertex_count()
                        : p.kind == PointKind::edge ? original.edge_count()
                                                    : original.face_count();
    if (p.element >= limit || !is_on_face(original, p, parent)) return std::nullopt;
    w[i] = weights_in_face(original, p, parent);
  }
  return (w[1][0] - w[0][0]) * (w[2][1] - w[0][1]) - (w[1][1] - w[0][1]) * (w[2][0] - w[0][0]);
}

Csr children_of_parents(const Work& work, Index original_faces, const RefinedMesh& refined) {
  const std::vector<Index>& parent = refined.parent;
  const Index disorder = sum(work, Cost::light, parent.size(), Index{0}, [&](std::size_t f) {
    return Index{parent[f] >= original_faces || (f > 0 && parent[f] < parent[f - 1])};
  });
  if (disorder > 0 || parent.empty())
    return build_csr(
        work, original_faces, parent.size(),
        [&](std::size_t f) { return parent[f] < original_faces ? parent[f] : kNone; },
        [](std::size_t f) { return static_cast<Index>(f); });
  // The usual case: children stand in the order of their parents, so the offsets can be written at once.
  Csr csr;
  csr.offset.resize(std::size_t{original_faces} + 1);
  csr.item.resize(parent.size());
  for_each(work, Cost::light, parent.size(), [&](std::size_t f) {
    csr.item[f] = static_cast<Index>(f);
    for (std::size_t p = f > 0 ? std::size_t{parent[f - 1]} + 1 : 0; p <= parent[f]; ++p)
      csr.offset[p] = static_cast<Index>(f);
  });
  for (std::size_t p = std::size_t{parent.back()} + 1; p <= original_faces; ++p)
    csr.offset[p] = static_cast<Index>(parent.size());
  return csr;
}

}  // namespace intarsia::kernels
