#include "graph/stages.h"

namespace intarsia::graph {

Ridges curvature_to_ridges(const Work& work, const Surface& surface, const Curvature& curvature, const Sharp& sharp,
                           CurveKind channel, const LayoutOptions& options) {
  const auto& near = channel == CurveKind::ridge ? sharp.edges.near_convex : sharp.edges.near_concave;
  return {kernels::trace_ridges(work, surface.mesh, curvature.fields, channel, near, options.ridges)};
}

}  // namespace intarsia::graph
