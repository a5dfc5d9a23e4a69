#include "kernels/curvature/curvature_lanes.h"

#include <cmath>

#include "kernels/curvature/lane_pack.h"

namespace intarsia::kernels {

namespace {

namespace baseline {
constexpr std::size_t kWidth = 2;
#include "kernels/curvature/curvature_lanes.inc"
}  // namespace baseline
INTARSIA_BEGIN_AVX2
constexpr std::size_t kWidth = 4;
#include "kernels/curvature/curvature_lanes.inc"
INTARSIA_END_SET
INTARSIA_BEGIN_AVX512
constexpr std::size_t kWidth = 8;
#include "kernels/curvature/curvature_lanes.inc"
INTARSIA_END_SET

}  // namespace

void lane_curvatures(InstructionSet set, const LaneFrames& frames, const LaneFits& fits, LaneCurvatures& out) {
  if (set == InstructionSet::avx512)
    avx512::lane_curvatures(frames, fits, out);
  else if (set == InstructionSet::avx2)
    avx2::lane_curvatures(frames, fits, out);
  else
    baseline::lane_curvatures(frames, fits, out);
}

void lane_normals(InstructionSet set, const LaneFrames& frames, const LaneFits& fits, LaneNormals& out) {
  if (set == InstructionSet::avx512)
    avx512::lane_normals(frames, fits, out);
  else if (set == InstructionSet::avx2)
    avx2::lane_normals(frames, fits, out);
  else
    baseline::lane_normals(frames, fits, out);
}

}  // namespace intarsia::kernels
