#include "graph/stages.h"

namespace intarsia::graph {

Sharp surface_to_sharp(const Work& work, const Surface& surface, const LayoutOptions& options) {
  return {kernels::sharp_edges(work, surface.mesh, surface.mean_edge, options.sharp)};
}

Scale surface_to_scale(const Work& work, const Surface& surface, const Sharp& /*sharp*/, const LayoutOptions& options) {
  return {kernels::compute_scale(work, surface.mesh, options.scale)};
}

}  // namespace intarsia::graph
