#include "tools/step/fit_layout.h"

#include <algorithm>
#include <numeric>

#include "engine/parallel/for_each.h"

namespace intarsia::tools {

LayoutFit fit_layout(const Work& work, const MeshView& mesh, std::span<const Index> label, const LayoutGraph& graph,
                     Real tolerance) {
  const PatchPieces pieces(mesh, label, graph);
  LayoutFit fit;
  FittedLayout& layout = fit.layout;
  layout.graph = &graph;
  layout.piece.resize(pieces.count()), layout.face.resize(pieces.count());
  std::vector<Index> order(pieces.count());  // the longest first
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return pieces.faces_of(a) > pieces.faces_of(b); });

  FitLimits limits;
  limits.inside = 0.75 * tolerance, limits.border = 0.3 * tolerance, limits.plane = 0.25 * tolerance;
  for_each(work, Cost::single, order.size(), [&](std::size_t i) {
    const Index p = order[i];
    layout.piece[p] = pieces.piece(p);
    layout.face[p] = fit_face(layout.piece[p], limits);
  });
  EdgeLimits edges;
  edges.move = 0.5 * tolerance, edges.curve = 0.15 * tolerance;
  limits.border = 0.2 * tolerance;
  EdgeFreedom freedom(graph);
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    share_edges(work, layout, edges, freedom, fit.model);
    for_each(work, Cost::single, order.size(), [&](std::size_t i) {
      const Index p = order[i];
      bool stale = false;
      for (const PatchPiece::Loop& l : layout.piece[p].loop)
        for (const PatchPiece::Side& s : l.side) stale = stale || freedom.stale[s.half_arc / 2];
      if (stale && layout.face[p].done && !layout.face[p].surface.is_plane)
        fit_again(layout.piece[p], guides_of(layout, freedom, fit.model, p), limits, layout.face[p]);
    });
    add_faces(work, layout, edges, freedom, fit.model);
    if (stiffen_crossings(work, fit.model, freedom) == 0) break;
  }
  return fit;
}

}  // namespace intarsia::tools
