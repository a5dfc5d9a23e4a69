// A layout as a CAD model: every patch a face, every arc an edge, every node a vertex.
#pragma once

#include <string>

#include "engine/parallel/work.h"
#include "tools/step/shared_edges.h"

namespace intarsia::tools {

struct LayoutFit {
  FittedLayout layout;
  CadModel model;
};

// Fits in two passes: each patch by itself; the arcs put where the surfaces meet; then each patch again towards these
// shared curves, so that neighbours leave no gap. tolerance: in units of the mesh; faces shall be closer to it.
// Ensures: the same bits for any number of threads. Errors: bad_file if the graph is not that of the mesh.
LayoutFit fit_layout(const Work& work, const MeshView& mesh, std::span<const Index> label, const LayoutGraph& graph,
                     Real tolerance);

}  // namespace intarsia::tools
