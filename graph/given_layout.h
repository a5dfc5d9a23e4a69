// Layouts that come from elsewhere, for judging them: refined meshes with a network, or labels of any mesh.
#pragma once

#include <vector>

#include "engine/data/curve_network.h"
#include "engine/data/layout_graph.h"
#include "engine/parallel/work.h"
#include "kernels/surface/normalise_box.h"

namespace intarsia::graph {

struct GivenLayout {
  Soup soup;                  // the input, in its order and units
  kernels::BoxTransform box;  // of the input
  Mesh mesh;                  // the input, normalised
  RefinedMesh refined;        // of it: mesh and parent; the rest is empty
  std::vector<Index> label;   // patch per refined face
  LayoutGraph graph;
};

// Everything but labels and graph, which are in the numbers of `refined`. The input is mended as in a run.
// Requires: one parent per refined face, below the input's number of faces.
// Errors: rejected.
GivenLayout given_refinement(const Work& work, Soup input, const Soup& refined, std::vector<Index> parent);

// Every connected piece of equal labels is a patch. smooth: borders smoothed as in a run; false: mesh edges as they
// come. Requires: one label per face.
// Errors: rejected if the input is no surface.
GivenLayout layout_of_labels(const Work& work, Soup input, std::vector<Index> label, bool smooth);

}  // namespace intarsia::graph
