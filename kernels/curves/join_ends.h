// Joins loose curve ends that continue each other (Cao, Yan, Wonka 2014, section 3.3).
#pragma once

#include "engine/data/feature_curves.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Angles in radians, lengths in mean edge lengths.
struct JoinOptions {
  Real radius = 3.5;                // largest distance of two ends (paper: 1-ring neighbourhoods)
  Real alpha = 1.0471975511965976;  // between the way out of one end and the gap; the paper's beta for the other end
  Real gamma = 1.5707963267948966;  // between the way out of one end and the way into the other
  Real direction_length = 4;        // the way out of an end is the chord over its last stretch of this length
  Real detour = 2;                  // the path over the mesh may be this much longer than the gap (at least one edge)
  Index min_points_to_close = 8;    // a curve may be joined to itself if it has as many points
  int passes = 4;
};

struct EndFrame {
  Vec3 point, outward, normal;
};

// The sum alpha + beta + gamma, or a negative number if the two ends must not be joined.
// Ends at the same place have no gap: only gamma counts.
Real join_angle(const EndFrame& a, const EndFrame& b, const JoinOptions& options);

// Ends of the same channel, both loose, best total angle first, each end once a pass. The gap is filled with points at
// vertices whose values run linearly from end to end. Curves of different kinds (a ridge and a sharp edge) share the
// end point; others become one curve.
// Requires: edge_length = mean edge length.
void join_ends(const Work& work, const MeshView& mesh, Real edge_length, const JoinOptions& options,
               FeatureCurves& curves);

}  // namespace intarsia::kernels
