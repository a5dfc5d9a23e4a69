#include <algorithm>

#include "engine/parallel/compact.h"
#include "engine/parallel/connect_mesh.h"
#include "engine/parallel/reduce.h"
#include "engine/parallel/single_precision.h"
#include "graph/stages.h"

namespace intarsia::graph {
namespace {

// What is still wanted of the cleaning, with the surface's order going back to the input itself.
void name_by_input(const Work& work, const Soup& input, const kernels::Cleaning& cleaning, Surface& s) {
  Mended& mended = s.mended;
  mended.done = cleaning.done, mended.speck_pieces = cleaning.speck_pieces;
  const Index vertices = input.vertex_count();
  mended.copy = compact(work, s.order.vertex.size(), [&](std::size_t v) { return s.order.vertex[v] >= vertices; });
  for (const Index v : mended.copy) s.order.vertex[v] = cleaning.copy_of[s.order.vertex[v] - vertices];
  for (Index& f : s.order.face) f = cleaning.input_triangle[f];
  for (Index t = 0; t < cleaning.triangle_of.size(); ++t) {
    const Index kept = cleaning.triangle_of[t];
    if (kept != kNone && cleaning.input_triangle[kept] != t)
      mended.twin.push_back(t), mended.twin_of.push_back(cleaning.input_triangle[kept]);
  }
  for (Index v = 0; v < cleaning.becomes.size(); ++v)
    if (cleaning.becomes[v] != v) mended.welded.push_back(v), mended.welded_into.push_back(cleaning.becomes[v]);
}

}  // namespace

Surface mesh_to_surface(const Work& work, const Soup& input, const kernels::CleanOptions& clean) {
  const kernels::Cleaning cleaning = kernels::clean_soup(work, input, clean);
  const Soup& soup = cleaning.changed ? cleaning.soup : input;
  Surface s;
  s.box = kernels::normalise_box(work, soup);
  s.order = kernels::canonical_order(work, soup, s.box, s.mesh);
  s.single_precision =
      is_single_precision(work, soup, s.order.vertex.size(), [&](std::size_t v) { return s.order.vertex[v]; });
  if (cleaning.changed) name_by_input(work, input, cleaning, s);
  connect_mesh(work, s.mesh);
  kernels::FaceGeometry faces = kernels::face_geometry(work, s.mesh);
  s.area = sum(work, Cost::light, faces.area.size(), 0.0, [&](std::size_t f) { return faces.area[f]; });
  s.face_normal = std::move(faces.normal);
  s.mean_edge = kernels::mean_edge_length(work, s.mesh);
  return s;
}

}  // namespace intarsia::graph
