#include "kernels/denoise/fit_positions.h"

#include <algorithm>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {

void fit_positions(const Work& work, const MeshView& mesh, Vec3View normal, int steps, Real reach,
                   Vec3Array& position) {
  const Vec3Array given = position;
  Vec3Array next(position.size());
  for (int step = 0; step < steps; ++step) {
    for_each(work, Cost::medium, position.size(), [&](std::size_t i) {
      const Index v = static_cast<Index>(i);
      const Vec3 p = position[v];
      Vec3 move = Vec3::Zero();
      for (const Index f : mesh.vertex_faces.row(v)) {
        const auto [a, b, c] = mesh.face(f);
        const Vec3 centre = (position[a] + position[b] + position[c]) / 3, n = normal[f];
        move += n.dot(centre - p) * n;
      }
      const Real faces = static_cast<Real>(mesh.vertex_faces.row(v).size());
      Vec3 away = p + move / std::max<Real>(1, faces) - given[v];
      const Real length = away.norm();
      if (length > reach) away *= reach / length;
      next.set(v, given[v] + away);
    });
    std::swap(next, position);
  }
}

}  // namespace intarsia::kernels
