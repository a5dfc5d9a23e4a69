#include "kernels/denoise/triangles.h"

#include <Eigen/Geometry>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {

Triangles triangles_of(const Work& work, const MeshView& mesh, Vec3View position) {
  const std::size_t n = mesh.face_count();
  Triangles t{Vec3Array(n), Vec3Array(n), std::vector<Real>(n)};
  for_each(work, Cost::light, n, [&](std::size_t f) {
    const auto [a, b, c] = mesh.face(static_cast<Index>(f));
    const Vec3 twice = (position[b] - position[a]).cross(position[c] - position[a]);
    const Real length = twice.norm();
    t.normal.set(f, length > 0 ? Vec3(twice / length) : Vec3::Zero());
    t.centroid.set(f, (position[a] + position[b] + position[c]) / 3);
    t.area[f] = length / 2;
  });
  return t;
}

Vec3Array positions_of(const Work& work, const MeshView& mesh) {
  Vec3Array position(mesh.vertex_count());
  for_each(work, Cost::light, position.size(),
           [&](std::size_t v) { position.set(v, mesh.point(static_cast<Index>(v))); });
  return position;
}

}  // namespace intarsia::kernels
