#include "kernels/baselines/exoskeleton.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/for_each.h"
#include "kernels/baselines/normal_regions.h"

namespace intarsia::kernels {

std::vector<Index> share_patches(const FaceGraph& graph, const PatchLabels& parts, Index patches) {
  NormalRegions r;
  r.region = parts.patch_of_face;
  refit(graph, r, parts.count);
  std::vector<Index> faces(parts.count, 0), share(parts.count, 1);
  for (const Index p : parts.patch_of_face) ++faces[p];
  // The next one goes where sqrt(E A) per patch is greatest (highest averages).
  for (Index given = parts.count; given < patches; ++given) {
    Index best = kNone;
    Real most = -1;
    for (Index p = 0; p < parts.count; ++p) {
      if (share[p] >= faces[p]) continue;
      const Real claim = std::sqrt(r.energy(p) * r.area[p]) / share[p];
      if (claim > most) most = claim, best = p;
    }
    if (best == kNone) break;
    ++share[best];
  }
  return share;
}

PatchLabels fit_parts(const Work& work, const FaceGraph& graph, const PatchLabels& parts, Index patches) {
  const std::vector<Index> share = share_patches(graph, parts, patches);
  const Csr faces = faces_of_patches(parts);
  std::vector<VsaFit> fit(parts.count);
  for_each(work, Cost::single, parts.count, [&](std::size_t p) {
    VsaOptions options;
    options.patches = share[p];
    fit[p] = fit_planes(work, subgraph(graph, faces.row(static_cast<Index>(p))), options);
  });
  PatchLabels labels;
  labels.patch_of_face.resize(graph.faces());
  for (Index p = 0; p < parts.count; ++p) {
    const auto row = faces.row(p);
    for (std::size_t i = 0; i < row.size(); ++i) labels.patch_of_face[row[i]] = labels.count + fit[p].region[i];
    labels.count += fit[p].count;
  }
  return labels;
}

}  // namespace intarsia::kernels
