// Ridges or valleys of a mesh as curves: crossings, segments, chains, and what is known at their points.
#pragma once

#include <cstdint>
#include <span>

#include "engine/data/feature_curves.h"
#include "engine/data/fields.h"
#include "engine/parallel/work.h"
#include "kernels/ridges/edge_crossings.h"
#include "kernels/ridges/face_segments.h"

namespace intarsia::kernels {

struct RidgeOptions {
  CrossingOptions crossing;
  int smoothing = 1;             // rounds of averaging of the extremality; paper mode: 0
  bool centre_of_points = true;  // where three lines meet in a face: mean of the three points; off: face barycentre
  Real straight = 1.0471975511965976;  // radians; the straightest two of three lines go through if they turn by less

  static RidgeOptions paper() {
    RidgeOptions o;
    o.smoothing = 0;
    o.centre_of_points = false;
    return o;
  }
};

// One channel (ridge or valley) of the surface. Nothing is filtered. Turn angles and measures are not filled.
// Requires: suppressed is empty or one byte per vertex, see edge_crossings.
// Ensures: every point lies on a vertex, an edge or in a face with three crossings; curves that pass the same vertex
// share its point; consecutive points lie in a common face and differ.
FeatureCurves trace_ridges(const Work& work, const MeshView& mesh, const CurvatureFields& fields, CurveKind channel,
                           std::span<const std::uint8_t> suppressed, const RidgeOptions& options);

}  // namespace intarsia::kernels
