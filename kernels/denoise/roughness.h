// How noisy a mesh is: how far the normals of triangles are from those of their neighbours.
#pragma once

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Median angle, in radians, between the normal of a triangle and the mean of those of its neighbours across edges.
// Small on smooth surfaces (edge length times curvature times unevenness), 0 on most of a part with sharp edges;
// Gaussian noise of sigma mean edges gives about 1.4 sigma radians while sigma < 0.2 (measured). Triangles without area
// or with a border edge do not count; 0 if none does. To 0.06 degrees.
Real roughness(const Work& work, const MeshView& mesh, Vec3View face_normal);

}  // namespace intarsia::kernels
