#include "tools/picture/normals.h"

#include <atomic>

#include "engine/parallel/for_each.h"

namespace intarsia::tools {

ShadingNormals shading_normals(const Work& work, const Shape& shape) {
  ShadingNormals normals;
  if (!shape.smooth || shape.vertex_normal.size() > 0 || shape.x.size() > kLargestSmoothed) return normals;
  normals.sum.assign(shape.x.size(), {0, 0, 0});
  constexpr Real kScale = 1 << 18;  // leaves room for 8000 faces around a vertex
  for_each(work, Cost::medium, shape.face_count(), [&](std::size_t f) {
    const Index* v = shape.corner.data() + 3 * f;
    const Vec3 p[3] = {shape.point(v[0]), shape.point(v[1]), shape.point(v[2])};
    const Vec3 n = (p[1] - p[0]).cross(p[2] - p[0]);
    const Real length = n.norm();
    if (!(length > 0)) return;
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
      const Real sides = a.norm() * b.norm();
      if (!(sides > 0)) continue;
      const Vec3 w = n * (kScale * 0.5 * (1 - a.dot(b) / sides) / length);
      for (int k = 0; k < 3; ++k)
        std::atomic_ref<std::int32_t>(normals.sum[v[i]][static_cast<std::size_t>(k)])
            .fetch_add(static_cast<std::int32_t>(w[k]), std::memory_order_relaxed);
    }
  });
  return normals;
}

}  // namespace intarsia::tools
