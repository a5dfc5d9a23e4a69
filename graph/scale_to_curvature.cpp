#include "graph/stages.h"

namespace intarsia::graph {

Curvature scale_to_curvature(const Work& work, const Surface& surface, const Scale& scale, const Sharp& sharp,
                             const LayoutOptions& options) {
  std::vector<std::uint8_t> barrier;
  if (options.barrier && !sharp.edges.edge.empty()) {
    barrier.assign(surface.mesh.edge_count(), 0);
    for (Index e : sharp.edges.edge) barrier[e] = 1;
  }
  return {kernels::compute_curvature(work, surface.mesh, surface.vertex_normal, scale.fields.fit_ring,
                                     scale.fields.levels, barrier, options.curvature)};
}

}  // namespace intarsia::graph
