#include "kernels/curvature/cubic_lanes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/curvature/cubic_rows.h"
#include "kernels/curvature/lane_pack.h"

namespace intarsia::kernels {

namespace {

struct Task {
  const LaneFrames& frames;
  const LaneDiscs* discs;
  const LanePoint* points;
  std::span<const LaneEntry> entries;
  Real gate, least_pivot;
  bool slopes;
  Real least_count;
  LaneFits& fits;
};

namespace baseline {
constexpr std::size_t kWidth = 2;
#include "kernels/curvature/cubic_lanes.inc"
}  // namespace baseline
INTARSIA_BEGIN_AVX2
constexpr std::size_t kWidth = 4;
#include "kernels/curvature/cubic_lanes.inc"
INTARSIA_END_SET
INTARSIA_BEGIN_AVX512
constexpr std::size_t kWidth = 8;
#include "kernels/curvature/cubic_lanes.inc"
INTARSIA_END_SET

template <std::size_t Terms>
void fit(InstructionSet set, const Task& t) {
  t.fits.solved = 0;
  if (set == InstructionSet::avx512)
    avx512::fit<Terms>(t);
  else if (set == InstructionSet::avx2)
    avx2::fit<Terms>(t);
  else
    baseline::fit<Terms>(t);
}

}  // namespace

void fit_ring_lanes(InstructionSet set, const LaneFrames& frames, std::span<const LanePoint> points,
                    std::span<const LaneEntry> entries, std::size_t terms, const FitOptions& options, LaneFits& fits) {
  const Task task{
      frames, nullptr, points.data(), entries, options.normal_gate, options.least_pivot, options.rows == Rows::slopes,
      3,      fits};
  if (terms == 9)
    fit<9>(set, task);
  else
    fit<7>(set, task);
}

void fit_disc_lanes(InstructionSet set, const LaneFrames& frames, const LaneDiscs& discs,
                    std::span<const LanePoint> points, std::span<const LaneEntry> entries, const FitOptions& options,
                    LaneFits& fits) {
  const Task task{frames, &discs, points.data(), entries, options.disc_gate, options.least_pivot, false, 5, fits};
  fit<10>(set, task);
}

}  // namespace intarsia::kernels
