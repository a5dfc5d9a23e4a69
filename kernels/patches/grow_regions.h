// Growing regions from seeds in the order of their fit to a proxy normal (Cohen-Steiner, Alliez, Desbrun 2004).
#pragma once

#include <span>
#include <vector>

#include "kernels/patches/region_graph.h"

namespace intarsia::kernels {

struct GrowOptions {
  // Key |n - N|^2, or A |n - N|^2 (paper): with the area small triangles are taken first and borders follow the
  // tessellation.
  bool area_in_key = false;
};

// |n - N|^2 of a node; 2 for a node without a normal.
Real deviation(const RegionGraph& graph, Index node, const Vec3& proxy);

// Region of every node. Order of the queue: (key, node, region).
// Requires: different seeds, one proxy each; the graph connected. Ensures: every region connected.
std::vector<Index> grow_regions(const Work& work, const RegionGraph& graph, std::span<const Index> seed,
                                std::span<const Vec3> proxy, const GrowOptions& options);

// Sharpens regions of balls to regions of faces: nodes next to another region, and all that is not joined to the
// region's seed node without them, are given up and grown again face by face.
// Requires: `graph` of this region, made with the same `normal`; label of every node. Ensures: regions.label written;
// every region connected.
void grow_faces(const Work& work, const PatchSurface& surface, const FaceVectors& normal, const Region& region,
                const RegionGraph& graph, std::span<const Index> node_label, std::span<const Index> seed,
                std::span<const Vec3> proxy, const GrowOptions& options, Regions& regions);

}  // namespace intarsia::kernels
