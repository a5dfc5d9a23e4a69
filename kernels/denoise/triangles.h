// Normals, centroids and areas for positions that change.
#pragma once

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct Triangles {
  Vec3Array normal, centroid;  // normal: unit, or 0 without area
  std::vector<Real> area;
};

Triangles triangles_of(const Work& work, const MeshView& mesh, Vec3View position);
Vec3Array positions_of(const Work& work, const MeshView& mesh);

}  // namespace intarsia::kernels
