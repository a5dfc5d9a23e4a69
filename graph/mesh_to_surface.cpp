#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/parallel/compact.h"
#include "engine/parallel/connect_mesh.h"
#include "engine/parallel/reduce.h"
#include "engine/parallel/single_precision.h"
#include "graph/stages.h"
#include "kernels/denoise/denoise.h"
#include "kernels/denoise/roughness.h"
#include "kernels/surface/split_long_edges.h"

namespace intarsia::graph {
namespace {

// What is still wanted of the cleaning, with the surface's order going back to the input itself.
void name_by_input(const Work& work, const Soup& input, const kernels::Cleaning& cleaning, Surface& s) {
  Mended& mended = s.mended;
  mended.done = cleaning.done, mended.speck_pieces = cleaning.speck_pieces;
  const Index vertices = input.vertex_count();
  mended.copy = compact(work, s.order.vertex.size(), [&](std::size_t v) { return s.order.vertex[v] >= vertices; });
  for (const Index v : mended.copy) {
    const Index copy = s.order.vertex[v] - vertices;
    s.order.vertex[v] = copy < cleaning.copy_of.size() ? cleaning.copy_of[copy] : kNone;
  }
  if (!cleaning.changed) return;
  for (Index& f : s.order.face) f = cleaning.input_triangle[f];
  for (Index t = 0; t < cleaning.triangle_of.size(); ++t) {
    const Index kept = cleaning.triangle_of[t];
    if (kept != kNone && cleaning.input_triangle[kept] != t)
      mended.twin.push_back(t), mended.twin_of.push_back(cleaning.input_triangle[kept]);
  }
  for (Index v = 0; v < cleaning.becomes.size(); ++v)
    if (cleaning.becomes[v] != v) mended.welded.push_back(v), mended.welded_into.push_back(cleaning.becomes[v]);
}

// Nothing if the triangles are even enough.
std::optional<kernels::SplitSoup> split_uneven(const Work& work, const Soup& soup, const LayoutOptions& options,
                                               Surface& s) {
  if (!options.split_uneven) return {};
  kernels::SplitEdgesOptions split = options.split_edges;
  if (kernels::edge_variation(work, soup) < split.uneven) {
    constexpr Real kEnough = 0.02;  // diagonals: flat faces need no finer ones
    if (!kernels::is_polyhedral(work, soup, split)) return {};
    split.length = std::max(split.length, kEnough);
  }
  if (kernels::has_pillows(work, soup)) return {};
  s.mended.split_length = kernels::split_length(work, soup, s.box.diagonal, split);
  return kernels::split_long_edges(work, soup, s.mended.split_length * s.box.diagonal);
}

// The surface gets other positions for the search; what was given is kept.
void search_on(Vec3Array position, Surface& s) {
  std::swap(s.mesh.x, position.x), std::swap(s.mesh.y, position.y), std::swap(s.mesh.z, position.z);
  if (s.given.size() == 0) s.given = std::move(position);
}

// True if the mesh was noisy and is filtered now.
bool filter_noise(const Work& work, const kernels::DenoiseOptions& options, Surface& s) {
  std::optional<Vec3Array> position = kernels::denoise(work, s.mesh, s.rough, s.mean_edge, options);
  if (position) search_on(std::move(*position), s);
  return position.has_value();
}

// True if small details are removed now.
bool drop_details(const Work& work, const LayoutOptions& options, Surface& s) {
  const Real size = options.min_feature.in_diagonals(s.box.diagonal, s.mean_edge);
  if (!(size > 0)) return false;
  search_on(kernels::remove_details(work, s.mesh, size, s.mean_edge, options.details), s);
  s.detail = std::max(s.detail, size / 2);
  return true;
}

}  // namespace

Surface mesh_to_surface(const Work& work, const Soup& input, const LayoutOptions& options) {
  const kernels::Cleaning cleaning = kernels::clean_soup(work, input, options.clean);
  const Soup& clean = cleaning.changed ? cleaning.soup : input;
  Surface s;
  s.input_triangles = input.face_count();
  s.box = kernels::normalise_box(work, clean);
  const std::optional<kernels::SplitSoup> split = split_uneven(work, clean, options, s);
  const Soup& soup = split ? split->soup : clean;
  s.order = kernels::canonical_order(work, soup, s.box, s.mesh);
  // Middles of edges say nothing about the input's precision: a vertex of the input stands for them.
  s.single_precision = is_single_precision(work, soup, s.order.vertex.size(), [&](std::size_t v) {
    return std::min(s.order.vertex[v], clean.vertex_count() - 1);
  });
  if (split)
    for (Index& f : s.order.face) f = split->parent[f];
  if (cleaning.changed || split) name_by_input(work, input, cleaning, s);
  connect_mesh(work, s.mesh);
  s.mean_edge = kernels::mean_edge_length(work, s.mesh);
  s.detail = std::max(s.mean_edge, options.finest_detail);
  kernels::FaceGeometry faces = kernels::face_geometry(work, s.mesh);
  s.rough = kernels::roughness(work, s.mesh, faces.normal);
  s.noisy = options.filter_noise && filter_noise(work, options.denoise, s);
  if (drop_details(work, options, s) || s.noisy) faces = kernels::face_geometry(work, s.mesh);
  s.area = sum(work, Cost::light, faces.area.size(), 0.0, [&](std::size_t f) { return faces.area[f]; });
  s.face_normal = std::move(faces.normal);
  return s;
}

}  // namespace intarsia::graph
