// Shape diameter function (Shapira, Shamir, Cohen-Or 2008, "Consistent mesh partitioning and skeletonisation using the
// shape diameter function"): how thick the body is behind each face.
#pragma once

#include <vector>

#include "engine/data/mesh.h"
#include "kernels/baselines/face_graph.h"

namespace intarsia::kernels {

struct DiameterOptions {
  int rays = 30;
  Real cone = 120;         // full opening in degrees
  Index samples = 20'000;  // more faces: one sample for a ball of faces, at its most central face
  int smoothing = 3;       // rounds of averaging over neighbours of similar value
};

// Per face, in units of the mesh: mean length of the rays into the body that lie within a standard deviation of their
// median, weighted against slant. Faces from which no ray hits anything take the value of what is around them; where
// there is none at all, 0.
std::vector<Real> shape_diameter(const Work& work, const MeshView& mesh, const FaceGraph& graph,
                                 const DiameterOptions& options);

}  // namespace intarsia::kernels
