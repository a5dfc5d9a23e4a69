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

// How freely points move towards where the surfaces meet. A border that would cross itself is made stiffer: an arc that
// only follows its ends, then with its nodes where they were, then with polylines as its images on the faces, which
// cannot cross where the flattenings are one-to-one.
enum class Freedom : std::uint8_t { full, ends_only, none, polyline };

struct EdgeFreedom {
  std::vector<Freedom> node, arc;
  std::vector<std::uint8_t> stale;  // per arc: its curve is to be made (again)

  explicit EdgeFreedom(const LayoutGraph& graph)
      : node(graph.node_count(), Freedom::full), arc(graph.arc_count(), Freedom::full), stale(graph.arc_count(), 1) {}
};

// Vertices and stale edges. An arc that no face uses has an edge without a curve.
// Newton-like: the point nearest to the tangent planes at its foot points, damped where these are nearly parallel. Near
// its ends an arc moves as they do.
void share_edges(const Work& work, const FittedLayout& layout, const EdgeLimits& limits, const EdgeFreedom& freedom,
                 CadModel& model);

// Samples of the shared curves around one patch with their feet on its face, and its corners.
std::vector<BorderGuide> guides_of(const FittedLayout& layout, const EdgeFreedom& freedom, const CadModel& model,
                                   Index patch);

// The faces: their loops with the curves on them, and the tolerances of edges and vertices as measured.
void add_faces(const Work& work, const FittedLayout& layout, const EdgeLimits& limits, const EdgeFreedom& freedom,
               CadModel& model);

// Takes freedom from the arcs (and from the nodes where arcs have none left) whose images cross on a face, and marks
// what has to be made again. Returns the number of faces with crossings.
Index stiffen_crossings(const Work& work, const CadModel& model, EdgeFreedom& freedom);

}  // namespace intarsia::tools
