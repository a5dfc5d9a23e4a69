#include "kernels/quality/geodesic_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace intarsia::kernels {
namespace {

constexpr Real kUnreached = std::numeric_limits<Real>::infinity();

// Distance at the origin if a plane front passes a (distance s) and b (distance t), both relative to the origin: the
// larger root of |gradient| = 1. Infinity if the front would not come through the segment from a to b.
Real through_triangle(const Vec3& a, const Vec3& b, Real s, Real t) {
  const Real aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b), det = aa * bb - ab * ab;
  if (!(det > 1e-14 * aa * bb)) return kUnreached;
  // Q = (P P^T)^-1 with rows a, b: the quadratic 1Q1 d^2 - 2 1Qt d + tQt - 1 = 0.
  const Real qaa = bb / det, qbb = aa / det, qab = -ab / det;
  const Real one_q_one = qaa + 2 * qab + qbb, one_q_t = (qaa + qab) * s + (qab + qbb) * t;
  const Real t_q_t = qaa * s * s + 2 * qab * s * t + qbb * t * t;
  const Real root = one_q_t * one_q_t - one_q_one * (t_q_t - 1);
  if (!(root >= 0 && one_q_one > 0)) return kUnreached;
  const Real d = (one_q_t + std::sqrt(root)) / one_q_one;
  const Real toward_a = qaa * (s - d) + qab * (t - d), toward_b = qab * (s - d) + qbb * (t - d);
  return toward_a <= 0 && toward_b <= 0 ? d : kUnreached;
}

}  // namespace

std::vector<Real> geodesic_distance(const Work& work, const MeshView& mesh, std::span<const Index> source) {
  struct Entry {
    Real distance;
    Index vertex;
    bool operator<(const Entry& o) const { return distance != o.distance ? distance > o.distance : vertex > o.vertex; }
  };
  std::vector<Real> distance(mesh.vertex_count(), kUnreached);
  std::vector<std::uint8_t> settled(mesh.vertex_count(), 0);
  std::priority_queue<Entry> queue;
  for (const Index v : source) distance[v] = 0, queue.push({0, v});
  for (std::size_t step = 0; !queue.empty(); ++step) {
    if (step % 4096 == 0) work.check();
    const Index v = queue.top().vertex;
    queue.pop();
    if (settled[v]) continue;
    settled[v] = 1;
    for (const Index f : mesh.vertex_faces.row(v)) {
      const std::array<Index, 3> corner = mesh.face(f);
      for (std::size_t i = 0; i < 3; ++i) {
        const Index w = corner[i];
        if (settled[w]) continue;
        const Vec3 p = mesh.point(w), a = mesh.point(v) - p;
        Real d = distance[v] + a.norm();
        for (std::size_t k = 1; k < 3; ++k) {
          const Index u = corner[(i + k) % 3];
          if (u != v && settled[u]) d = std::min(d, through_triangle(a, mesh.point(u) - p, distance[v], distance[u]));
        }
        if (d < distance[w]) distance[w] = d, queue.push({d, w});
      }
    }
  }
  return distance;
}

}  // namespace intarsia::kernels
