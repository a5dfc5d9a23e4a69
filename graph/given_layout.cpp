#include "graph/given_layout.h"

#include <numeric>
#include <string>

#include "engine/parallel/connect_mesh.h"
#include "engine/parallel/for_each.h"
#include "graph/empty_network.h"
#include "graph/stages.h"
#include "kernels/layout/trace_boundaries.h"
#include "kernels/patches/flood_patches.h"
#include "kernels/surface/check_soup.h"
#include "kernels/surface/clean_soup.h"

namespace intarsia::graph {
namespace {

Mesh normalised(const Work& work, const Soup& soup, const kernels::BoxTransform& box) {
  kernels::check_soup(work, soup);
  Mesh mesh;
  mesh.x.resize(soup.vertex_count()), mesh.y.resize(soup.vertex_count()), mesh.z.resize(soup.vertex_count());
  for_each(work, Cost::light, soup.vertex_count(), [&](std::size_t v) {
    const Vec3 p = box.to_unit({soup.x[v], soup.y[v], soup.z[v]});
    mesh.x[v] = p.x(), mesh.y[v] = p.y(), mesh.z[v] = p.z();
  });
  mesh.corner = soup.corner;
  connect_mesh(work, mesh);
  return mesh;
}

// The labels as borders of the mesh itself. All count as features, so that corners of borders become nodes.
void trace_labels(const Work& work, const std::vector<Index>& label, GivenLayout& layout) {
  RefinedMesh& refined = layout.refined;
  refined.mesh = layout.mesh;
  const MeshView mesh = refined.mesh;
  refined.parent.resize(mesh.face_count());
  std::iota(refined.parent.begin(), refined.parent.end(), Index{0});
  const PatchLabels labels = kernels::flood_equal(work, mesh, label);
  layout.label = labels.patch_of_face;
  refined.on_network.resize(mesh.edge_count());
  refined.edge_kind.resize(mesh.edge_count());
  refined.edge_strength.resize(mesh.edge_count());
  for_each(work, Cost::light, mesh.edge_count(), [&](std::size_t i) {
    const Index e = static_cast<Index>(i);
    const bool boundary = mesh.is_boundary_edge(e);
    refined.edge_kind[e] = boundary ? CurveKind::border : CurveKind::sharp;
    refined.on_network[e] = boundary || layout.label[mesh.edge_f0[e]] != layout.label[mesh.edge_f1[e]] ? 1 : 0;
  });
  layout.graph = kernels::trace_boundaries(work, refined, layout.label, labels.count);
}

// The labels through the last stage of a run.
void smooth_labels(const Work& work, const std::vector<Index>& label, GivenLayout& layout) {
  LayoutOptions options;
  const Surface surface = mesh_to_surface(work, layout.soup);
  const Sharp sharp = surface_to_sharp(work, surface, options);
  const Scale scale = surface_to_scale(work, surface, sharp, options);
  const Curvature curvature = scale_to_curvature(work, surface, scale, sharp, options);
  const Network network = empty_network(work, surface);
  std::vector<Index> reordered(label.size());
  for (std::size_t f = 0; f < label.size(); ++f) reordered[f] = label[surface.order.face[f]];
  const Patches patches = patches_of_labels(work, network, surface, reordered);
  Layout smoothed = patches_to_layout(work, surface, curvature, network, patches, options);
  layout.refined = std::move(smoothed.refined);
  layout.label = std::move(smoothed.labels.patch_of_face);
  layout.graph = std::move(smoothed.graph);
  for (Index& parent : layout.refined.parent) parent = surface.order.face[parent];
}

}  // namespace

GivenLayout given_refinement(const Work& work, Soup input, const Soup& refined, std::vector<Index> parent) {
  GivenLayout layout;
  layout.soup = std::move(input);
  kernels::Cleaning cleaning = kernels::clean_soup(work, layout.soup, {});
  if (cleaning.changed) layout.soup = std::move(cleaning.soup);
  layout.box = kernels::normalise_box(work, layout.soup);
  layout.mesh = normalised(work, layout.soup, layout.box);
  layout.refined.mesh = normalised(work, refined, layout.box);
  layout.refined.parent = std::move(parent);
  if (!cleaning.changed) return layout;
  for (Index& p : layout.refined.parent) {
    p = cleaning.triangle_of[p];
    if (p == kNone)
      throw Error(
          ErrorCode::rejected,
          "a face of the layout comes from a triangle that cleaning drops; make the layout again without options "
          "of clean");
  }
  return layout;
}

GivenLayout layout_of_labels(const Work& work, Soup input, std::vector<Index> label, bool smooth) {
  GivenLayout layout;
  layout.soup = std::move(input);
  kernels::Cleaning cleaning = kernels::clean_soup(work, layout.soup, {});
  if (cleaning.changed) {
    layout.soup = std::move(cleaning.soup);
    std::vector<Index> kept;
    for (const Index t : cleaning.input_triangle) kept.push_back(label[t]);
    label = std::move(kept);
  }
  layout.box = kernels::normalise_box(work, layout.soup);
  layout.mesh = normalised(work, layout.soup, layout.box);
  if (smooth)
    smooth_labels(work, label, layout);
  else
    trace_labels(work, label, layout);
  return layout;
}

}  // namespace intarsia::graph
