#include "kernels/baselines/shape_diameter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/parallel/for_each.h"
#include "engine/space/triangle_tree.h"

namespace intarsia::kernels {
namespace {

constexpr Real kPi = std::numbers::pi;

struct Ray {
  Vec3 direction;  // about +z
  Real weight;
};

// Directions spread over the cone in a golden spiral, weighted by the cosine of their slant.
std::vector<Ray> rays_of(const DiameterOptions& options) {
  const Real least = std::cos(options.cone / 2 * kPi / 180), turn = kPi * (3 - std::sqrt(5.0));
  std::vector<Ray> rays;
  for (int i = 0; i < options.rays; ++i) {
    const Real z = 1 - (1 - least) * (i + 0.5) / options.rays, r = std::sqrt(1 - z * z);
    rays.push_back({Vec3(r * std::cos(turn * i), r * std::sin(turn * i), z), z});
  }
  return rays;
}

// The face of each ball nearest to its centroid.
std::vector<Index> central_faces(const FaceGraph& graph, const BallGraph& balls) {
  std::vector<Index> face(balls.graph.faces(), kNone);
  std::vector<Real> least(balls.graph.faces(), std::numeric_limits<Real>::infinity());
  for (Index f = 0; f < graph.faces(); ++f) {
    const Index b = balls.ball[f];
    if (!(graph.area[f] > 0)) continue;
    const Real d = (graph.centroid[f] - balls.graph.centroid[b]).squaredNorm();
    if (d < least[b]) least[b] = d, face[b] = f;
  }
  return face;
}

// Mean of the lengths within a standard deviation of the median; negative without any.
Real robust_mean(std::vector<std::pair<Real, Real>>& length_weight) {
  if (length_weight.empty()) return -1;
  std::sort(length_weight.begin(), length_weight.end());
  const Real median = length_weight[length_weight.size() / 2].first;
  Real square = 0;
  for (const auto& [l, w] : length_weight) square += (l - median) * (l - median);
  const Real deviation = std::sqrt(square / static_cast<Real>(length_weight.size()));
  Real sum = 0, weight = 0;
  for (const auto& [l, w] : length_weight)
    if (std::abs(l - median) <= deviation * (1 + 1e-9)) sum += w * l, weight += w;
  return sum / weight;
}

// Values below 0 are unknown: they spread in from known ones.
void fill_unknown(const FaceGraph& graph, std::vector<Real>& value) {
  std::vector<Index> front;
  for (Index b = 0; b < graph.faces(); ++b)
    if (value[b] >= 0) front.push_back(b);
  for (std::size_t i = 0; i < front.size(); ++i)
    for (const Index o : graph.around(front[i]))
      if (o != kNone && value[o] < 0) value[o] = value[front[i]], front.push_back(o);
  for (Real& v : value) v = std::max(v, Real{0});
}

void smooth(const FaceGraph& graph, std::vector<Real>& value, int rounds) {
  constexpr Real kSimilar = 0.3;  // relative difference
  std::vector<Real> next(value.size());
  for (int round = 0; round < rounds; ++round) {
    for (Index b = 0; b < graph.faces(); ++b) {
      Real sum = value[b] * graph.area[b], weight = graph.area[b];
      for (const Index o : graph.around(b)) {
        if (o == kNone) continue;
        const Real difference = std::abs(value[o] - value[b]) / (kSimilar * std::max({value[o], value[b], 1e-300}));
        const Real w = graph.area[o] * std::exp(-difference * difference);
        sum += w * value[o], weight += w;
      }
      next[b] = weight > 0 ? sum / weight : value[b];
    }
    value.swap(next);
  }
}

}  // namespace

std::vector<Real> shape_diameter(const Work& work, const MeshView& mesh, const FaceGraph& graph,
                                 const DiameterOptions& options) {
  const BallGraph balls = gather_balls(work, graph, std::max(Index{1}, graph.faces() / options.samples));
  const std::vector<Index> face = central_faces(graph, balls);
  const std::vector<Ray> rays = rays_of(options);
  const TriangleTree tree(work, {{mesh.x, mesh.y, mesh.z}, mesh.corner});
  std::vector<Real> value(face.size(), -1);
  for_each_block(work, Cost::heavy, face.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
    std::vector<std::pair<Real, Real>> hits;
    for (std::size_t b = begin; b < end; ++b) {
      const Index f = face[b];
      if (f == kNone) continue;
      const Vec3 in = -graph.normal[f], u = in.unitOrthogonal(), v = in.cross(u);
      const Real least = 1e-3 * std::sqrt(graph.area[f]);
      hits.clear();
      for (const Ray& ray : rays) {
        const Vec3 d = ray.direction.x() * u + ray.direction.y() * v + ray.direction.z() * in;
        const Real length = tree.first_hit(graph.centroid[f], d, least);
        if (std::isfinite(length)) hits.emplace_back(length, ray.weight);
      }
      value[b] = robust_mean(hits);
    }
  });
  fill_unknown(balls.graph, value);
  smooth(balls.graph, value, options.smoothing);
  std::vector<Real> of_face(graph.faces());
  for (Index f = 0; f < graph.faces(); ++f) of_face[f] = value[balls.ball[f]];
  return of_face;
}

}  // namespace intarsia::kernels
