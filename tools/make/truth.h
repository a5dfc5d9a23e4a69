// The feature curves that a shape has by construction.
#pragma once

#include <filesystem>

#include "tools/make/shape.h"

namespace intarsia::tools {

struct TrueCurve {
  std::vector<Vec3> point;  // on the surface, in order
  bool closed = false;      // the last point joins the first
};

struct TrueFeatures {
  std::vector<TrueCurve> curves;
  std::vector<Vec3> corners;
};

// rounded-box: the middle lines of the 12 edge fillets and the middles of the 8 corners (lines end where the spheres of
//   the corners begin; an edge without length is left out).
// cube: its 12 edges, from corner to corner, and 8 corners.
// ellipsoid: the ridge around the plane of the two longer axes, if the shortest is shorter than the others; else none.
// star: the crests of the ridges as far as they are crisp, up to 0.75 of the way from the equator to either pole. The
//   line of extremal curvature lies within the width of the crest of them.
// half-pipe: the middle lines of the two lips.
// Other shapes: nothing. `samples`: points along a curved line, at least 2.
// Errors: as check().
TrueFeatures true_features(const MakeOptions& options, int samples = 400);

// OBJ: one `l` element per curve (the first point repeated at the end of a closed one), one `p` element per corner.
// Written under a temporary name and renamed. Errors: write_failed.
void write_truth(const TrueFeatures& features, const std::filesystem::path& path);

}  // namespace intarsia::tools
