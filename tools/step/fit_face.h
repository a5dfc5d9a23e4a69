// The surface of one patch: a plane where that does, else a spline surface over a flattening of the patch.
#pragma once

#include <span>

#include "tools/step/fit_spline.h"
#include "tools/step/flatten.h"

namespace intarsia::tools {

// In the units of the patch.
struct FitLimits {
  Real inside = 0;           // wanted distance of the patch's points from the surface
  Real border = 0;           // the same for its border
  Real plane = 0;            // a patch that is closer than that to a plane becomes one
  int most_control = 12000;  // control points of a face, at most
};

// A point that the border of a face has to pass, and where the face's surface has it.
struct BorderGuide {
  Vec2 uv;
  Vec3 point;
  Real length = 0;      // of the border that it stands for
  bool corner = false;  // the surface has this point at uv, as nearly as its net lets it
};

struct FittedFace {
  bool done = false;  // false: nothing can carry this patch (`trouble` says why)
  const char* trouble = "";
  FaceSurface surface;
  Flattening flattening = Flattening::projection;
  std::vector<Vec2> uv;         // per point of the piece
  Real inside = 0, border = 0;  // largest distances of the samples that were fitted
};

// Tries the flattenings in their order until one is fitted within the limits, or keeps the best. Gauss-Newton foot
// points once per fit, so that distances count and not parameters (Hoschek 1988). Nets grow by a factor of 1.5.
FittedFace fit_face(const PatchPiece& piece, const FitLimits& limits);

// Again with the same flattening, towards guides instead of the mesh's own border; nets as before or finer. Planes
// stay.
void fit_again(const PatchPiece& piece, std::span<const BorderGuide> guides, const FitLimits& limits, FittedFace& face);

}  // namespace intarsia::tools
