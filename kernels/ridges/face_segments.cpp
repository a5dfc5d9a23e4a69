#include "kernels/ridges/face_segments.h"

#include "engine/parallel/compact.h"
#include "engine/parallel/scan.h"

namespace intarsia::kernels {

SegmentGraph face_segments(const Work& work, const MeshView& mesh, std::span<const Index> crossing_edge) {
  SegmentGraph graph;
  graph.crossing_count = static_cast<Index>(crossing_edge.size());
  std::vector<Index> node(mesh.edge_count(), kNone);
  for_each(work, Cost::light, crossing_edge.size(),
           [&](std::size_t i) { node[crossing_edge[i]] = static_cast<Index>(i); });
  const auto crossings_in = [&](std::size_t f) {
    int n = 0;
    for (int i = 0; i < 3; ++i) n += node[mesh.face_edge[3 * f + i]] != kNone;
    return n;
  };
  const auto crossed = compact(work, mesh.face_count(), [&](std::size_t f) { return crossings_in(f) >= 2; });
  std::vector<Index> first(crossed.size()), centre(crossed.size());
  for_each(work, Cost::light, crossed.size(), [&](std::size_t i) {
    const bool three = crossings_in(crossed[i]) == 3;
    first[i] = three ? 3 : 1;
    centre[i] = three ? 1 : 0;
  });
  const Index segments = exclusive_scan<Index>(work, first);
  graph.centre_face.resize(exclusive_scan<Index>(work, centre));
  graph.a.resize(segments), graph.b.resize(segments), graph.face.resize(segments);
  for_each(work, Cost::light, crossed.size(), [&](std::size_t i) {
    const Index f = crossed[i];
    Index found[3], n = 0;
    for (int k = 0; k < 3; ++k)
      if (const Index at = node[mesh.face_edge[3 * f + k]]; at != kNone) found[n++] = at;
    if (n == 2) {
      graph.a[first[i]] = found[0], graph.b[first[i]] = found[1], graph.face[first[i]] = f;
      return;
    }
    graph.centre_face[centre[i]] = f;
    for (Index k = 0; k < 3; ++k) {
      graph.a[first[i] + k] = found[k];
      graph.b[first[i] + k] = graph.crossing_count + centre[i];
      graph.face[first[i] + k] = f;
    }
  });
  return graph;
}

}  // namespace intarsia::kernels
