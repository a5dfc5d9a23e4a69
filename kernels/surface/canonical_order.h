// Numbers vertices and faces by where they are: any order of the input's vertices and faces gives the same mesh, bit by
// bit, and neighbours in memory are neighbours on the surface.
#pragma once

#include <span>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"
#include "kernels/surface/normalise_box.h"

namespace intarsia::kernels {

// Maps from the mesh's numbers back to the soup's.
struct SurfaceOrder {
  std::vector<Index> vertex;  // mesh vertex -> soup vertex
  std::vector<Index> face;    // mesh face -> soup triangle
};

// Fills mesh.x, y, z (normalised) and mesh.corner; connectivity is connect_mesh's. Vertices that no face uses are
// dropped. Vertices in kd order (kd_order.h), vertices at one place as duplicate_rank.h says; each face starts with its
// smallest vertex, faces sorted by their corners.
// Requires: check_soup accepts the soup; transform = normalise_box of it.
SurfaceOrder canonical_order(const Work& work, const Soup& soup, const BoxTransform& transform, Mesh& mesh);

// old -> new for a map new -> old; kNone for what was dropped.
std::vector<Index> inverse_order(const Work& work, std::span<const Index> order, Index old_count);

}  // namespace intarsia::kernels
