// The line field that curve extension follows: the principal direction of the smaller |curvature|, smoothed.
#pragma once

#include <vector>

#include "engine/data/fields.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct DirectionFieldOptions {
  int smoothing = 3;           // rounds of tensor averaging over the closed 1-ring (0 in paper mode)
  Real full_confidence = 2.0;  // |k| (per diagonal) from which curvature counts as certain
};

struct DirectionField {
  Vec3Array direction;            // unit tangent line, sign free; zero where nothing is known
  std::vector<float> confidence;  // 0 (isotropic or flat) .. 1
  std::vector<float> ridge;       // max(kmax, 0) as a share of its 95th percentile, at most 1
  std::vector<float> valley;      // the same of max(-kmin, 0)
};

// Requires: fields of mesh.vertex_count() vertices, lengths in diagonals.
DirectionField direction_field(const Work& work, const MeshView& mesh, const CurvatureFields& fields,
                               const DirectionFieldOptions& options);

}  // namespace intarsia::kernels
