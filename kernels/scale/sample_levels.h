// Building coarse samples: neighbouring vertices are gathered into connected clusters of about 4, those into clusters
// of about 16, and so on. Clusters never cross the blocks of the loops, so that blocks run side by side and the result
// does not depend on threads; it relies on neighbours having near ids (the canonical vertex order).
#pragma once

#include <span>
#include <vector>

#include "engine/data/disc_walk.h"
#include "engine/data/mesh.h"
#include "engine/data/sample_levels.h"
#include "engine/parallel/work.h"
#include "kernels/scale/sample_tiles.h"
#include "kernels/scale/voting_faces.h"
#include "kernels/scale/voting_tensor.h"

namespace intarsia::kernels {

struct LevelBuild {
  SampleLevels levels;
  std::vector<SampleSums> sums;    // per level
  std::vector<SampleTiles> tiles;  // per level
};

// Levels for discs up to `max_radius` and one above them; fewer where a level would not shrink the one below.
LevelBuild build_sample_levels(const Work& work, const MeshView& mesh, std::span<const VotingFace> faces,
                               Real max_radius);

// Surface variation in the disc `code` around the centre of cluster c of level 0: Eq. 6 over the tensors of the
// clusters, weighted by exp(-d / radius) and ramp(d).
Real disc_variation(const LevelBuild& build, Index c, int code, DiscWalker& walker);

}  // namespace intarsia::kernels
