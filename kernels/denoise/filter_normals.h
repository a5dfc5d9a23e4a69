// Smooths the normals of triangles and keeps creases.
// Source: Zhang, Deng, Zhang, Bouaziz, Liu 2015, "Guided mesh normal filtering", Eq. 3 to 8; joint bilateral filter
// guided by the mean normal of the most uniform patch around each triangle.
#pragma once

#include "engine/data/csr.h"
#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct NormalFilterOptions {
  int iterations = 20;
  Real sigma = 0.35;  // of differences of normals (sigma_r)
};

// Triangles that share a vertex with each triangle, itself not among them; ascending.
Csr triangle_rings(const Work& work, const MeshView& mesh);

// normal: in and out, unit or 0. Requires: area and centroid of the triangles; rings = triangle_rings of the mesh.
void filter_normals(const Work& work, const MeshView& mesh, const Csr& rings, std::span<const Real> area,
                    Vec3View centroid, const NormalFilterOptions& options, Vec3Array& normal);

}  // namespace intarsia::kernels
