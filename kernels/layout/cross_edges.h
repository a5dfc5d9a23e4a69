// From smoothed points to curves that can be embedded: each arc becomes the sequence of mesh edges it crosses.
#pragma once

#include <span>
#include <vector>

#include "engine/data/layout_graph.h"
#include "engine/parallel/work.h"
#include "kernels/layout/smooth_boundaries.h"

namespace intarsia::kernels {

struct CrossOptions {
  Real snap = 0.1;      // a crossing nearer than this share of the edge to its end moves to the vertex
  Real margin = 0.02;   // crossings that do not snap keep this distance from the ends
  Real min_gap = 1e-3;  // between two crossings of one edge; otherwise their arcs are in conflict
};

struct CrossedArcs {
  CurveNetwork network;                 // curve a = arc a of the graph; points on the original mesh
  std::vector<std::uint8_t> as_traced;  // per arc: 1 if it keeps the chain it came with (fixed, kept or reverted)
  Index reverted = 0;                   // arcs put back because of a conflict or because no path was found
};

// Consecutive smoothed points are joined by plane sections; only the edge crossings stay, pulled tight where a path
// crosses the same edge back and forth. Fixed points and nodes stay as points. An arc in conflict with another one (see
// curve_conflicts.h) first gives up snapping, then goes back to its chain, and so do the nodes at its ends.
// Requires: smoothed comes from smooth_boundaries on the same graph. keep_chain: empty, or one flag per arc; a flagged
// arc keeps its chain.
// Ensures: consecutive points of a curve share a face; no conflicts, provided the chains themselves have none; curves
// share exactly the points of their common nodes; point strength = turn angle of the arc at that point.
CrossedArcs cross_edges(const Work& work, MeshView original, const RefinedMesh& refined, const LayoutGraph& graph,
                        const SmoothedArcs& smoothed, std::span<const std::uint8_t> keep_chain = {},
                        const CrossOptions& options = {});

}  // namespace intarsia::kernels
