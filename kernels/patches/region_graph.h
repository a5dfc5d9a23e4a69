// The dual graph of one region, of its faces or of small balls of faces: what region growing runs on.
#pragma once

#include <span>
#include <vector>

#include "kernels/patches/patch_surface.h"
#include "kernels/patches/regions.h"

namespace intarsia::kernels {

struct RegionGraph {
  std::vector<Index> node_of_face;  // by rank in the region's face list
  std::vector<Real> area;
  Vec3Array normal_sum;              // sum of area times unit normal
  Vec3Array mean_normal;             // what growing compares with a proxy; at most 1 long
  Vec3Array centroid;                // area-weighted
  std::vector<Index> offset, other;  // neighbours, ascending in a row
  bool is_faces = false;             // node = face, in the order of the list

  Index nodes() const { return static_cast<Index>(area.size()); }
  std::span<const Index> row(Index n) const {
    return std::span<const Index>(other).subspan(offset[n], offset[n + 1] - offset[n]);
  }
};

// node_size: about how many faces a node takes; 1 = one each. A ball stops at faces that turn more than about 37
// degrees from its first one. `normal`: per face of the surface, what mean_normal is made of (smooth_normals).
// Requires: region.faces connected. Writes regions.position of these faces.
RegionGraph make_region_graph(const Work& work, const PatchSurface& surface, const Region& region, Index node_size,
                              const FaceVectors& normal, Regions& regions);

// Nodes per region that keep a Lloyd iteration near a millisecond: 1 for small regions, balls for large ones.
Index node_size_for(std::size_t faces);

// The k nodes farthest from each other along the surface (greedy, the first two by a double sweep), and the node
// nearest to each: regions are connected. Steps across bends count up to three times their length.
struct FarSeeds {
  std::vector<Index> seed;
  std::vector<Index> label;
};
FarSeeds farthest_seeds(const Work& work, const RegionGraph& graph, Index k);

// Nearest seed of every node, by the same distance. Ties: smaller label.
std::vector<Index> nearest_seed(const Work& work, const RegionGraph& graph, std::span<const Index> seed);

}  // namespace intarsia::kernels
