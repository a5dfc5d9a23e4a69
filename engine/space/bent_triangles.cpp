#include "engine/space/bent_triangles.h"

#include <algorithm>

namespace intarsia {

void BentTriangles::assign(std::span<const Vec3> point, std::span<const Vec3> inward, std::span<const Index> offset,
                           std::span<const std::array<Index, 3>> triangle) {
  point_ = point, triangle_ = triangle;
  next_.resize(point.size());
  along_.assign(point.size(), Vec3::Zero());
  for (std::size_t l = 0; l + 1 < offset.size(); ++l)
    for (Index i = offset[l]; i < offset[l + 1]; ++i) {
      next_[i] = i + 1 == offset[l + 1] ? offset[l] : i + 1;
      const Index before = i == offset[l] ? offset[l + 1] - 1 : i - 1;
      const Vec3 t = point[next_[i]] - point[before];
      if (const Real length = t.norm(); length > 0) along_[i] = t / length;
    }
  const auto bend = [&](Index a, Index b) -> Vec3 {
    if (inward[a].squaredNorm() == 0 || next_[a] == b || next_[b] == a) return Vec3::Zero();
    const Vec3 d = point[b] - point[a];
    const Vec3 across = d - d.dot(along_[a]) * along_[a];
    return (across.norm() * inward[a] - across) / 3;
  };
  bend_.resize(triangle.size());
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = triangle[t][i], b = triangle[t][(i + 1) % 3];
      bend_[t].side[i][0] = bend(a, b), bend_[t].side[i][1] = bend(b, a);
      sum += bend_[t].side[i][0] + bend_[t].side[i][1];
    }
    bend_[t].middle = sum / 4;  // 3/2 of the mean
  }
}

Vec3 BentTriangles::offset_at(std::size_t t, const Vec3& q) const {
  const Vec3 &a = point_[triangle_[t][0]], u = point_[triangle_[t][1]] - a, v = point_[triangle_[t][2]] - a, d = q - a;
  const Real uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), ud = u.dot(d), vd = v.dot(d);
  const Real det = uu * vv - uv * uv;
  if (!(det > 1e-12 * uu * vv)) return Vec3::Zero();
  Real w[3];
  w[1] = std::clamp((vv * ud - uv * vd) / det, Real{0}, Real{1});
  w[2] = std::clamp((uu * vd - uv * ud) / det, Real{0}, Real{1});
  w[0] = std::max(1 - w[1] - w[2], Real{0});
  Vec3 sum = 6 * w[0] * w[1] * w[2] * bend_[t].middle;
  for (std::size_t i = 0; i < 3; ++i) {
    const Real x = w[i], y = w[(i + 1) % 3];
    sum += 3 * x * y * (x * bend_[t].side[i][0] + y * bend_[t].side[i][1]);
  }
  return sum;
}

}  // namespace intarsia
