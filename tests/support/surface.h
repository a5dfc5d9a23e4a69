// A soup made into the surface that kernels take, by the same steps as the program.
#pragma once

#include "engine/parallel/connect_mesh.h"
#include "kernels/surface/canonical_order.h"
#include "kernels/surface/check_soup.h"
#include "kernels/surface/normalise_box.h"
#include "kernels/surface/normals.h"
#include "tests/support/run_with_threads.h"
#include "tests/support/shapes.h"

namespace intarsia::test {

struct TestSurface {
  Mesh mesh;                    // normalised: box centre 0, diagonal 1
  kernels::FaceGeometry faces;  // unit normals, areas, centroids
  Vec3Array vertex_normal;
  Real mean_edge = 0;
  kernels::BoxTransform box;    // normalised -> input: box.to_input(p)
  kernels::SurfaceOrder order;  // mesh ids -> soup ids

  MeshView view() const { return mesh.view(); }
  Vec3 point(Index v) const { return {mesh.x[v], mesh.y[v], mesh.z[v]}; }
  Vec3 input_point(Index v) const { return box.to_input(point(v)); }
};

inline TestSurface make_surface(const Soup& soup, const Work& work = {}) {
  TestSurface s;
  kernels::check_soup(work, soup);
  s.box = kernels::normalise_box(work, soup);
  s.order = kernels::canonical_order(work, soup, s.box, s.mesh);
  connect_mesh(work, s.mesh);
  s.faces = kernels::face_geometry(work, s.mesh);
  s.vertex_normal = kernels::vertex_normals(work, s.mesh, s.faces);
  s.mean_edge = kernels::mean_edge_length(work, s.mesh);
  return s;
}

}  // namespace intarsia::test
