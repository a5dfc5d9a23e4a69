// One curve per arc and one point per node, put where the surfaces on both sides meet, and its images on these.
#pragma once

#include <span>

#include "engine/parallel/work.h"
#include "tools/step/cad_model.h"
#include "tools/step/fit_face.h"

namespace intarsia::tools {

// Patches and their fitted faces, side by side. Faces that are not done are as if they were not there.
struct FittedLayout {
  const LayoutGraph* graph = nullptr;
  std::vector<PatchPiece> piece;
  std::vector<FittedFace> face;
};

struct EdgeLimits {
  Real move = 0;   // how far points may move from the arc towards where the surfaces meet
  Real curve = 0;  // wanted distance of curves from their points, in space and on the faces
};

// Vertices and edges only. An arc that no face uses has an edge without a curve.
// Newton-like: the point nearest to the tangent planes at its foot points, damped where these are nearly parallel.
CadModel share_edges(const Work& work, const FittedLayout& layout, const EdgeLimits& limits);

// Samples of the shared curves around one patch, with their feet on its face.
std::vector<BorderGuide> guides_of(const FittedLayout& layout, const CadModel& model, Index patch);

// Adds the faces: their loops with the curves on them, and the tolerances of edges and vertices as measured.
void add_faces(const Work& work, const FittedLayout& layout, const EdgeLimits& limits, CadModel& model);

}  // namespace intarsia::tools
