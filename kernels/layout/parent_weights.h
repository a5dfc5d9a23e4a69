// Refined faces seen from their parents, in barycentric terms: exact for thin parents too.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "engine/data/curve_network.h"
#include "kernels/layout/surface_path.h"

namespace intarsia::kernels {

// The signed share of its parent's area that a refined face covers (1 for an uncut face); empty if one of its corners
// does not lie on the parent.
inline std::optional<Real> share_of_parent(const MeshView& original, const RefinedMesh& refined, Index f) {
  const Index parent = refined.parent[f];
  if (parent >= original.face_count()) return std::nullopt;
  std::array<std::array<Real, 3>, 3> w;
  for (int i = 0; i < 3; ++i) {
    const SurfacePoint& p = refined.origin[refined.mesh.corner[3 * f + i]];
    const Index limit = p.kind == PointKind::vertex ? original.vertex_count()
                        : p.kind == PointKind::edge ? original.edge_count()
                                                    : original.face_count();
    if (p.element >= limit || !is_on_face(original, p, parent)) return std::nullopt;
    w[i] = weights_in_face(original, p, parent);
  }
  return (w[1][0] - w[0][0]) * (w[2][1] - w[0][1]) - (w[1][1] - w[0][1]) * (w[2][0] - w[0][0]);
}

}  // namespace intarsia::kernels
