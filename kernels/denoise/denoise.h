// A noisy mesh without its noise, creases kept: what features are looked for on. The input's positions stay what they
// are; only the search uses these.
#pragma once

#include <optional>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"
#include "kernels/denoise/filter_normals.h"

namespace intarsia::kernels {

struct DenoiseOptions {
  Real least = 0.122;  // roughness from which a mesh counts as noisy, radians (7 degrees); clean scans have up to 6.8
  Index least_triangles = 2000;  // coarser meshes are rough without noise
  NormalFilterOptions filter;
  int rounds = 1;  // of filtering normals and fitting positions
  int position_steps = 15;
  Real reach = 3;  // farthest move, mean edges
};

// New positions of the vertices, or nothing if the mesh is not noisy. rough: roughness of the mesh; mean_edge > 0.
std::optional<Vec3Array> denoise(const Work& work, const MeshView& mesh, Real rough, Real mean_edge,
                                 const DenoiseOptions& options);

}  // namespace intarsia::kernels
