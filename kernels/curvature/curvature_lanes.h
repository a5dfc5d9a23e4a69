// Principal curvatures, directions and extremalities of eight fits side by side, and the normals of pass B: the
// formulas of principal_curvature.h and extremality.h for fits in the frame of the normal, where the gradient is 0.
#pragma once

#include "kernels/curvature/cubic_lanes.h"

namespace intarsia::kernels {

struct LaneCurvatures {
  LaneReals kmax, kmin, tmax_x, tmax_y, tmax_z, tmin_x, tmin_y, tmin_z, emax, emin;
};
// Reads b and c of the fits. Lanes that are not solved hold anything.
void lane_curvatures(InstructionSet set, const LaneFrames& frames, const LaneFits& fits, LaneCurvatures& out);

// n - g1 u - g2 v, unit. Lanes that are not solved hold anything.
struct LaneNormals {
  LaneReals x, y, z;
};
void lane_normals(InstructionSet set, const LaneFrames& frames, const LaneFits& fits, LaneNormals& out);

}  // namespace intarsia::kernels
