// A surface without details below a size, larger edges kept: for coins, hair and text, of which nobody wants patches.
// Source: Wang, Fu, Liu, Tong, Liu, Guo 2015, "Rolling guidance normal filter for geometric processing": normals are
// smoothed until small details are gone, and then get back, step by step, what is larger.
#pragma once

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct DetailOptions {
  Real sigma = 0.25;  // of differences of normals in the guide
  int rounds = 5;     // of guidance
};

// New positions of the vertices. size: in the mesh's units, width of what is to go; mean_edge > 0. Linear in the
// vertices times (size / mean_edge)^2, which is bounded: on very fine meshes details are removed as far as that goes.
Vec3Array remove_details(const Work& work, const MeshView& mesh, Real size, Real mean_edge,
                         const DetailOptions& options);

}  // namespace intarsia::kernels
