#include "graph/baseline_graph.h"

#include "kernels/baselines/vsa.h"

namespace intarsia::graph {

std::vector<Index> baseline_labels(const Work& work, const Surface& surface, Baseline method, Index patches) {
  const kernels::FaceGraph faces = kernels::make_face_graph(work, surface.mesh, surface.face_normal);
  switch (method) {
    case Baseline::vsa:
      return kernels::fit_planes(work, faces, {.patches = patches}).region;
  }
  throw Error(ErrorCode::internal, "no such baseline");
}

Patches baseline_patches(const Work& work, const Surface& surface, const Network& network, Baseline method,
                         Index patches) {
  return patches_of_labels(work, network, surface, baseline_labels(work, surface, method, patches));
}

}  // namespace intarsia::graph
