// Layouts with known truth.
#pragma once

#include "engine/parallel/connect_mesh.h"
#include "kernels/layout/trace_boundaries.h"
#include "kernels/patches/flood_patches.h"
#include "tests/support/shapes.h"

namespace intarsia::test {

struct Labelled {
  RefinedMesh refined;
  std::vector<Index> label;
  LayoutGraph graph;
};

// Connected faces of equal label are patches.
template <class LabelOf>
Labelled labelled(const Soup& soup, const LabelOf& label_of) {
  const Work work;
  Labelled out;
  Mesh& mesh = out.refined.mesh;
  mesh.x = soup.x, mesh.y = soup.y, mesh.z = soup.z, mesh.corner = soup.corner;
  connect_mesh(work, mesh);
  const MeshView view = mesh;
  std::vector<Index> label;
  for (Index f = 0; f < view.face_count(); ++f) {
    const auto c = view.face(f);
    const Vec3 a = view.point(c[0]), b = view.point(c[1]), d = view.point(c[2]);
    label.push_back(label_of((a + b + d) / 3, (b - a).cross(d - a).normalized()));
  }
  const PatchLabels patches = kernels::flood_equal(work, mesh, label);
  out.label = patches.patch_of_face;
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const bool border = view.is_boundary_edge(e);
    out.refined.on_network.push_back(border || out.label[view.edge_f0[e]] != out.label[view.edge_f1[e]] ? 1 : 0);
    out.refined.edge_kind.push_back(border ? CurveKind::border : CurveKind::sharp);
  }
  out.refined.edge_strength.resize(mesh.edge_count());
  out.graph = kernels::trace_boundaries(work, out.refined, out.label, patches.count);
  return out;
}

}  // namespace intarsia::test
