#include "engine/parallel/connect_mesh.h"
#include "engine/parallel/reduce.h"
#include "engine/parallel/single_precision.h"
#include "graph/stages.h"
#include "kernels/surface/check_soup.h"

namespace intarsia::graph {

Surface mesh_to_surface(const Work& work, const Soup& soup) {
  kernels::check_soup(work, soup);
  Surface s;
  s.box = kernels::normalise_box(work, soup);
  s.order = kernels::canonical_order(work, soup, s.box, s.mesh);
  connect_mesh(work, s.mesh);
  kernels::FaceGeometry faces = kernels::face_geometry(work, s.mesh);
  s.area = sum(work, Cost::light, faces.area.size(), 0.0, [&](std::size_t f) { return faces.area[f]; });
  s.face_normal = std::move(faces.normal);
  s.mean_edge = kernels::mean_edge_length(work, s.mesh);
  s.single_precision =
      is_single_precision(work, soup, s.order.vertex.size(), [&](std::size_t v) { return s.order.vertex[v]; });
  return s;
}

}  // namespace intarsia::graph
