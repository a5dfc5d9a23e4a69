// A vertex of its own for every fan of triangles.
#pragma once

#include <span>
#include <vector>

#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Gives the corners that are joined by walking from triangle to triangle across partner sides one vertex. The fan with
// the smallest corner keeps the vertex; the others get new ones, numbered from `vertices` on in the order of their
// smallest corners. Changes `corner`; returns the old vertex of every new one.
// partner: per side 3 t + i (from corner i to i + 1) the side across, or kNone (orient_triangles.h). Joined sides join
// the corners at the same vertex, whichever way their triangles run.
std::vector<Index> split_vertices(const Work& work, Index vertices, std::span<const Index> partner,
                                  std::vector<Index>& corner);

}  // namespace intarsia::kernels
