#include "kernels/denoise/denoise.h"

#include "kernels/denoise/fit_positions.h"
#include "kernels/denoise/triangles.h"

namespace intarsia::kernels {
std::optional<Vec3Array> denoise(const Work& work, const MeshView& mesh, Real rough, Real mean_edge,
                                 const DenoiseOptions& options) {
  if (!(rough >= options.least) || mesh.face_count() < options.least_triangles) return {};
  const Csr rings = triangle_rings(work, mesh);
  Vec3Array position = positions_of(work, mesh);
  for (int round = 0; round < options.rounds; ++round) {
    Triangles t = triangles_of(work, mesh, position);
    filter_normals(work, mesh, rings, t.area, t.centroid, options.filter, t.normal);
    fit_positions(work, mesh, t.normal, options.position_steps, options.reach * mean_edge, position);
  }
  return position;
}

}  // namespace intarsia::kernels
