#include <algorithm>

#include "graph/stages.h"

namespace intarsia::graph {

Curvature scale_to_curvature(const Work& work, const Surface& surface, const Scale& scale, const Sharp& sharp,
                             const LayoutOptions& options) {
  std::vector<std::uint8_t> barrier;
  if (options.barrier && !sharp.edges.edge.empty()) {
    barrier.assign(surface.mesh.edge_count(), 0);
    for (Index e : sharp.edges.edge) barrier[e] = 1;
  }
  kernels::CurvatureOptions fit = options.curvature;
  constexpr Real kFloatTurn = 1e-4;  // radians: what float coordinates turn a plane by, a few rings wide
  if (surface.single_precision) fit.flat_turn = std::max(fit.flat_turn, kFloatTurn);
  const Vec3Array normal = kernels::vertex_normals(work, surface.mesh, kernels::face_geometry(work, surface.mesh));
  return {
      kernels::compute_curvature(work, surface.mesh, normal, scale.fields.fit_ring, scale.fields.levels, barrier, fit)};
}

}  // namespace intarsia::graph
