// What the smoothing of borders needs of the curvature: a quarter of its memory, so that the rest can be freed early.
#pragma once

#include <array>
#include <vector>

#include "engine/data/fields.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct PrincipalLines {
  std::array<std::vector<float>, 3> tmax, tmin;  // unit, sign free
  // (larger - smaller) / larger of |kmax| and |kmin|, times min(1, larger / 2); 0 where directions mean nothing.
  std::vector<float> confidence;

  Index vertex_count() const { return static_cast<Index>(confidence.size()); }
};

PrincipalLines principal_lines(const Work& work, const CurvatureFields& fields);

}  // namespace intarsia::kernels
