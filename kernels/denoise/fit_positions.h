// Moves vertices so that triangles take given normals.
// Source: Sun, Rosin, Martin, Langbein 2007, "Fast and effective feature-preserving mesh denoising", Eq. 11.
#pragma once

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Steps of p += mean over the triangles of a vertex of n (n . (c - p)), c the centroid. No vertex goes farther than
// `reach` from where it was. position: in and out.
void fit_positions(const Work& work, const MeshView& mesh, Vec3View normal, int steps, Real reach, Vec3Array& position);

}  // namespace intarsia::kernels
