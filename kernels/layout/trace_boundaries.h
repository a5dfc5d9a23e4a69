// From labelled faces to the graph of the layout: nodes, arcs between them, loops around every patch.
#pragma once

#include <span>

#include "engine/data/layout_graph.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct TraceOptions {
  Real corner_angle = 60;  // degrees: a feature or border chain that turns more gets a node
  Real corner_chord = 3;   // mean edges: length of the chords between which the turn is measured
};

// Border edges are those on the mesh boundary and those between two different labels; network edges inside a patch do
// not count. A border edge outside the network counts as a subdivision edge.
// Nodes: border vertices of degree != 2; of degree 2 where features (ridge, valley, sharp), border and free kinds meet;
// corners of feature and border chains. A loop without any node gets an artificial one at its smallest vertex.
// Requires: label.size() == refined faces, every label < patch_count.
// Ensures: nodes ascend by vertex; arcs ascend by (start vertex, first edge); every half-arc with a patch on its left
// is in exactly one loop; loops ascend by (patch, smallest half-arc). Left and right patches are constant along an arc.
LayoutGraph trace_boundaries(const Work& work, const RefinedMesh& refined, std::span<const Index> label,
                             Index patch_count, const TraceOptions& options = {});

}  // namespace intarsia::kernels
