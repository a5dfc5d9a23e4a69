// Triangles on the faces of a model, for measuring: every corner lies on its face exactly.
#pragma once

#include "tools/step/shared_edges.h"

namespace intarsia::tools {

struct ModelTriangles {
  std::vector<Real> x, y, z;
  std::vector<Index> corner;  // 3 per triangle
  std::vector<Index> face;    // per triangle: position in the model's faces
};

// The triangles of the patches, their borders put on the faces' own, each divided until it is within about `deflection`
// of its face. Neighbouring triangles may be divided differently: the cracks are smaller than that.
ModelTriangles triangulate_model(const Work& work, const FittedLayout& layout, const CadModel& model, Real deflection);

}  // namespace intarsia::tools
