#include "graph/stages.h"

namespace intarsia::graph {

Sharp surface_to_sharp(const Work& work, const Surface& surface, const LayoutOptions& options) {
  return {kernels::sharp_edges(work, surface.mesh, surface.mean_edge, options.sharp)};
}

Scale surface_to_scale(const Work& work, const Surface& surface, const Sharp& /*sharp*/, const LayoutOptions& options) {
  Scale scale{kernels::compute_scale(work, surface.mesh, options.scale)};
  if (options.fixed_ring > 0) {
    const auto ring = static_cast<std::uint8_t>(options.fixed_ring);
    scale.fields.scale.assign(surface.mesh.vertex_count(), ring);
    scale.fields.fit_ring = scale.fields.scale;
    scale.fields.levels = {};
  }
  return scale;
}

}  // namespace intarsia::graph
