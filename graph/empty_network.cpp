#include "graph/empty_network.h"

#include <numeric>

#include "engine/parallel/for_each.h"
#include "kernels/patches/flood_patches.h"
#include "kernels/patches/subdivide.h"

namespace intarsia::graph {

Network empty_network(const Work& work, const Surface& surface) {
  Network n;
  RefinedMesh& r = n.refined;
  r.mesh = surface.mesh;
  r.parent.resize(r.mesh.face_count());
  std::iota(r.parent.begin(), r.parent.end(), Index{0});
  r.mesh.vertex_vertices = {};
  r.origin = VertexOrigins(r.mesh.vertex_count(), {});
  const MeshView mesh = r.mesh;
  r.on_network.resize(mesh.edge_count());
  r.edge_kind.assign(mesh.edge_count(), CurveKind::border);
  r.edge_strength.resize(mesh.edge_count());
  for_each(work, Cost::light, mesh.edge_count(),
           [&](std::size_t e) { r.on_network[e] = mesh.edge_f1[e] == kNone ? 1 : 0; });
  n.patches = kernels::flood_patches(work, mesh, r.on_network).count;
  return n;
}

Patches patches_of_labels(const Work& work, const Network& network, const Surface& surface,
                          std::span<const Index> label) {
  Patches p;
  p.labels = kernels::flood_equal(work, surface.mesh, label);
  kernels::mark_borders(work, network.refined, p.labels, p.on_network, p.edge_kind);
  p.network_patches = network.patches, p.merged_patches = p.labels.count;
  return p;
}

}  // namespace intarsia::graph
