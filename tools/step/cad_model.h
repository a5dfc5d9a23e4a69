// A layout as faces, edges and vertices that share each other: what a STEP file holds, in plain numbers.
#pragma once

#include <algorithm>
#include <vector>

#include "tools/step/spline.h"

namespace intarsia::tools {

struct CadVertex {
  Vec3 point;
  Real tolerance = 0;  // the ends of its edges, and their places on the faces, are within
  Real gap = 0;        // largest distance of its places on the faces, as measured
};

struct CadEdge {
  Index start = 0, end = 0;  // vertices; a closed edge begins and ends in one
  SplineCurve<Vec3> curve;   // from start to end exactly
  bool is_line = false;
  Real deviation = 0;  // of the curve from the points it was fitted to
  Real tolerance = 0;  // of its curves on the faces from it
};

// An edge as part of a face's border: its image on the face, over the parameters of the edge's curve.
struct CadSide {
  Index edge = 0;
  bool forward = true;
  SplineCurve<Vec2> curve;
  std::vector<Real> knot;  // with `corner`: a polyline instead of the curve, for what would cross itself otherwise
  std::vector<Vec2> corner;

  Vec2 at(Real t) const {
    if (corner.empty()) return curve.at(t);
    const auto next = std::upper_bound(knot.begin() + 1, knot.end() - 1, t) - knot.begin();
    const Real s = (t - knot[next - 1]) / (knot[next] - knot[next - 1]);
    return (1 - s) * corner[next - 1] + s * corner[next];
  }
};

struct CadFace {
  Index patch = 0;
  FaceSurface surface;                      // its normal points outwards
  std::vector<std::vector<CadSide>> loops;  // the face on their left, the outer one first
};

struct CadModel {
  std::vector<CadVertex> vertex;
  std::vector<CadEdge> edge;
  std::vector<CadFace> face;
};

}  // namespace intarsia::tools
