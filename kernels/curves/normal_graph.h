// The surface as a graph of points with area normals, no finer than a given spacing: what turn angles are read from.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/csr.h"
#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct NormalGraph {
  Vec3Array point;             // mean of the node's vertices
  Vec3Array normal;            // sum of their area normals (a third of each face), not unit
  Csr neighbours;              // empty where `node_of` is: the mesh's own
  std::vector<Index> node_of;  // vertex -> node; empty = identity

  Index node(Index v) const { return node_of.empty() ? v : node_of[v]; }
};

// A node is a connected set of vertices inside one cube of side `spacing`; with spacing 0 every vertex is a node.
// Vertices with barrier[v] != 0 (empty: none) stay alone, so that no node reaches across them.
NormalGraph normal_graph(const Work& work, const MeshView& mesh, std::span<const std::uint8_t> barrier, Real spacing);

}  // namespace intarsia::kernels
