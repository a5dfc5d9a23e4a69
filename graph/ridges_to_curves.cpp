#include "graph/stages.h"

namespace intarsia::graph {

Curves ridges_to_curves(const Work& work, const Surface& surface, const Ridges& ridges, const Ridges& valleys,
                        const Sharp& sharp, const LayoutOptions& options) {
  return {kernels::connect_features(work, surface.mesh, surface.mean_edge, ridges.curves, valleys.curves,
                                    sharp.edges.curves, options.curves)};
}

}  // namespace intarsia::graph
