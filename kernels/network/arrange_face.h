// Triangulation of one triangle that is crossed by segments: the local step of embedding curves in a mesh.
#pragma once

#include <array>
#include <vector>

#include "engine/base/types.h"

namespace intarsia::kernels {

// A point of the reference triangle (0,0), (1,0), (0,1). All tests of topology run in these coordinates, so that a
// face without area is as good as any other.
struct PlanePoint {
  Real u = 0, v = 0;
};

struct FaceSegment {
  Index a = 0, b = 0;  // indices into FaceArrangement::point
  Index tag = 0;       // the caller's; sub-segments inherit it, kNone = a helper edge that carries no curve
};

// In: points and segments. Out: points (crossings appended), segments (split, none crossing another), triangles.
struct FaceArrangement {
  std::vector<PlanePoint> point;  // first `boundary` of them: the triangle's border, counter-clockwise
  Index boundary = 3;
  Index given = 3;                   // points known to the caller; later ones are crossings
  std::vector<FaceSegment> segment;  // inside the face; none along the border
  std::vector<std::array<Index, 3>> triangle;
};

// Requires: border points in counter-clockwise order starting at corner 0, all different; interior points inside.
// Ensures: every segment is an edge of the triangulation; triangles are counter-clockwise and cover the face once.
void arrange_face(FaceArrangement& face);

}  // namespace intarsia::kernels
