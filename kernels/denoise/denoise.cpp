#include "kernels/denoise/denoise.h"

#include <Eigen/Geometry>

#include "engine/parallel/for_each.h"
#include "kernels/denoise/fit_positions.h"

namespace intarsia::kernels {
namespace {

struct Triangles {
  Vec3Array normal, centroid;
  std::vector<Real> area;
};

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

}  // namespace

std::optional<Vec3Array> denoise(const Work& work, const MeshView& mesh, Real rough, Real mean_edge,
                                 const DenoiseOptions& options) {
  if (!(rough >= options.least)) return {};
  const Csr rings = triangle_rings(work, mesh);
  Vec3Array position(mesh.vertex_count());
  for_each(work, Cost::light, mesh.vertex_count(),
           [&](std::size_t v) { position.set(v, mesh.point(static_cast<Index>(v))); });
  for (int round = 0; round < options.rounds; ++round) {
    Triangles t = triangles_of(work, mesh, position);
    filter_normals(work, mesh, rings, t.area, t.centroid, options.filter, t.normal);
    fit_positions(work, mesh, t.normal, options.position_steps, options.reach * mean_edge, position);
  }
  return position;
}

}  // namespace intarsia::kernels
