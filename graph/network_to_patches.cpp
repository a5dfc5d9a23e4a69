#include "graph/stages.h"

namespace intarsia::graph {

Patches network_to_patches(const Work& work, const Surface& surface, const Network& network,
                           const LayoutOptions& options) {
  kernels::SubdivideOptions o = options.subdivide;
  o.patches = options.patches;
  kernels::Subdivision s = kernels::subdivide(work, network.refined, surface.face_normal, surface.mean_edge, o);
  Patches p;
  p.labels = std::move(s.labels);
  p.on_network = std::move(s.on_network);
  p.edge_kind = std::move(s.edge_kind);
  p.network_patches = s.network_patches;
  p.merged_patches = s.merged_patches;
  p.warnings = std::move(s.warnings);
  return p;
}

}  // namespace intarsia::graph
