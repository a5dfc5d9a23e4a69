#include "kernels/patches/subdivide.h"

#include "engine/parallel/for_each.h"
#include "kernels/patches/flood_patches.h"
#include "kernels/patches/measure_patches.h"

namespace intarsia::kernels {

SubdivideOptions robust_subdivision() { return {}; }

SubdivideOptions paper_subdivision(std::uint64_t seed) {
  SubdivideOptions o;
  o.discs = false;
  o.split = paper_split(seed);
  return o;
}

void mark_borders(const Work& work, const RefinedMesh& refined, const PatchLabels& labels,
                  std::vector<std::uint8_t>& on_network, std::vector<CurveKind>& edge_kind) {
  const MeshView mesh = refined.mesh.view();
  on_network.resize(mesh.edge_count());
  edge_kind.resize(mesh.edge_count());
  for_each(work, Cost::light, mesh.edge_count(), [&](std::size_t e) {
    const bool boundary = mesh.edge_f1[e] == kNone;
    const bool border = boundary || labels.patch_of_face[mesh.edge_f0[e]] != labels.patch_of_face[mesh.edge_f1[e]];
    on_network[e] = border ? 1 : 0;
    if (refined.on_network[e])
      edge_kind[e] = refined.edge_kind[e];
    else
      edge_kind[e] = boundary ? CurveKind::border : CurveKind::subdivision;
  });
}

Subdivision subdivide(const Work& work, const RefinedMesh& refined, Vec3View parent_normal, Real mean_edge,
                      const SubdivideOptions& options, std::span<const std::uint8_t> locked) {
  const PatchSurface surface = make_patch_surface(work, refined, parent_normal, mean_edge, options.hole_length, locked);
  Subdivision out;
  PatchLabels labels = flood_patches(work, surface.mesh, refined.on_network);
  out.network_patches = labels.count;
  if (options.merge_tiny) labels = merge_patches(work, surface, labels, options.merge);
  out.merged_patches = labels.count;
  labels = split_patches(work, surface, labels, options.split);
  if (options.discs) labels = cut_to_discs(work, surface, labels, options.disc);
  if (options.merge_tiny) {
    MergeOptions slivers = options.merge;
    slivers.keep_discs = options.discs;
    labels = merge_patches(work, surface, labels, slivers);
  }
  if (options.patches > 0 && labels.count != options.patches) {
    ReachOptions reach;
    reach.discs = options.discs, reach.merge = options.merge, reach.split = options.split;
    ReachedCount reached = reach_count(work, surface, labels, options.patches, reach);
    labels = std::move(reached.labels);
    if (labels.count != options.patches)
      out.warnings.push_back("wanted " + std::to_string(options.patches) + " patches, got " +
                             std::to_string(labels.count) + ": " + reached.reason);
  }
  out.table = measure_patches(work, surface, labels);
  for (Index p = 0; p < labels.count; ++p) out.not_discs += out.table.is_disc(p) ? 0 : 1;
  if (options.discs && out.not_discs > 0)
    out.warnings.push_back(std::to_string(out.not_discs) + " of " + std::to_string(labels.count) +
                           " patches are not discs");
  mark_borders(work, refined, labels, out.on_network, out.edge_kind);
  out.labels = std::move(labels);
  return out;
}

}  // namespace intarsia::kernels
