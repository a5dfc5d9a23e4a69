// Normals, areas and centroids of a triangle mesh.
#pragma once

#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// A triangle lower than this over its longest side (in bounding-box diagonals) has no direction that rounding leaves.
inline constexpr Real kFlatHeight = 1e-14;

struct FaceGeometry {
  Vec3Array normal;        // unit; 0 for a degenerate face
  std::vector<Real> area;  // 0 for a degenerate face
  Vec3Array centroid;      // mean of the corners, also for a degenerate face
};

// Requires: positions in bounding-box units (finite).
// Ensures: no NaN; area > 0 exactly where the normal is not 0.
FaceGeometry face_geometry(const Work& work, const MeshView& mesh);

// Unit normals by the weights of Max 1999 ("Weights for computing vertex normals from facet normals"):
// n = sum over the fan of (a x b) / (|a|^2 |b|^2), a and b the edges of the face at the vertex; exact where all
// neighbours lie on a sphere through the vertex. Degenerate faces are skipped. Where the sum vanishes: the
// area-weighted sum, else the largest face, else that of the neighbours' faces, else +z. Ensures: every normal has
// length 1 (up to rounding).
Vec3Array vertex_normals(const Work& work, const MeshView& mesh, const FaceGeometry& faces);

// Mean over all edges; 0 for a mesh without edges.
Real mean_edge_length(const Work& work, const MeshView& mesh);

}  // namespace intarsia::kernels
