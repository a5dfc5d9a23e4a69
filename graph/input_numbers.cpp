#include "graph/input_numbers.h"

#include "engine/parallel/for_each.h"

namespace intarsia::graph {

LayoutView layout_view(const Soup& soup, const Surface& surface, const Layout& layout) {
  LayoutView view;
  view.soup = &soup;
  view.vertex_order = surface.order.vertex, view.face_order = surface.order.face;
  view.divided = surface.mended.split_length > 0;
  view.copies = surface.mended.copy, view.twin = surface.mended.twin, view.twin_of = surface.mended.twin_of;
  view.centre = surface.box.centre, view.diagonal = surface.box.diagonal;
  view.refined = &layout.refined, view.labels = &layout.labels, view.graph = &layout.graph;
  view.interior = &layout.interior, view.mesh = surface.mesh, view.face_patch = layout.face_patch;
  view.given = surface.given;
  return view;
}

std::vector<Index> surface_vertices(const Work& work, const Soup& soup, const Surface& surface) {
  const std::vector<Index>& copies = surface.mended.copy;
  std::vector<Index> out(soup.vertex_count(), kNone);
  for_each(work, Cost::light, surface.order.vertex.size(), [&](std::size_t v) {
    if (!std::binary_search(copies.begin(), copies.end(), static_cast<Index>(v)))
      out[surface.order.vertex[v]] = static_cast<Index>(v);
  });
  const auto& [welded, into] = std::tie(surface.mended.welded, surface.mended.welded_into);
  for (std::size_t i = 0; i < welded.size(); ++i) out[welded[i]] = out[into[i]];
  return out;
}

}  // namespace intarsia::graph
