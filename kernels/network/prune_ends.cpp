#include "kernels/network/prune_ends.h"

#include "engine/parallel/compact.h"

namespace intarsia::kernels {

Index prune_ends(const Work& work, const MeshView& mesh, std::vector<std::uint8_t>& active) {
  const std::vector<Index> network = compact(work, active.size(), [&](std::size_t e) { return active[e] != 0; });
  std::vector<Index> degree(mesh.vertex_count(), 0), sum(mesh.vertex_count(), 0);  // sum of edge ids: the last one left
  for (Index e : network)
    for (Index v : {mesh.edge_v0[e], mesh.edge_v1[e]}) ++degree[v], sum[v] += e;
  Index cleared = 0;
  for (Index first : network) {
    if (!active[first]) continue;
    for (Index start : {mesh.edge_v0[first], mesh.edge_v1[first]})
      for (Index v = start; degree[v] == 1;) {
        const Index e = sum[v];
        if (mesh.is_boundary_edge(e)) break;
        active[e] = 0;
        ++cleared;
        const Index w = mesh.other_vertex(e, v);
        --degree[v], --degree[w], sum[v] -= e, sum[w] -= e;
        v = w;
      }
  }
  return cleared;
}

}  // namespace intarsia::kernels
