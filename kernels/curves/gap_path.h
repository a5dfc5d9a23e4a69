// The way from one curve end to another over the mesh, not touching other curves.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/surface_point.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Shortest path p -> vertices -> q along mesh edges, shorter than max_length in all. Neighbours on the path share a
// face; if p and q already do, the path has no vertices. Vertices with used_vertex and edges with used_edge are
// avoided (those that p and q lie on excepted).
// Requires: one byte per vertex and per edge.
// Ensures: false, and `vertices` empty, if there is no such path.
bool gap_path(const MeshView& mesh, std::span<const std::uint8_t> used_vertex, std::span<const std::uint8_t> used_edge,
              const SurfacePoint& p, const SurfacePoint& q, Real max_length, std::vector<Index>& vertices);

}  // namespace intarsia::kernels
