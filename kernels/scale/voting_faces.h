// What voting in lanes needs of a face, 32 bytes in single precision: faces are gathered, not streamed. At most 3e-8
// diagonals are lost of a position: less than a thousandth of an edge up to a hundred million vertices.
#pragma once

#include <span>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct alignas(32) VotingFace {
  float centroid[3];
  float area;       // 0 for degenerate faces: they vote for nothing
  float normal[3];  // unit; zero where area is 0
  float zero;
};

std::vector<VotingFace> voting_faces(const Work& work, const MeshView& mesh);

}  // namespace intarsia::kernels
