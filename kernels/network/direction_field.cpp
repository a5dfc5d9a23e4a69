#include "kernels/network/direction_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {
namespace {

using Tensor = std::array<float, 6>;  // xx xy xz yy yz zz

Tensor line_tensor(const Vec3& t, Real weight) {
  const auto f = [&](Real v) { return static_cast<float>(weight * v); };
  return {f(t.x() * t.x()), f(t.x() * t.y()), f(t.x() * t.z()), f(t.y() * t.y()), f(t.y() * t.z()), f(t.z() * t.z())};
}

Vec3 times(const Tensor& m, const Vec3& v) {
  return {m[0] * v.x() + m[1] * v.y() + m[2] * v.z(), m[1] * v.x() + m[3] * v.y() + m[4] * v.z(),
          m[2] * v.x() + m[4] * v.y() + m[5] * v.z()};
}

Tensor vertex_tensor(const CurvatureFields& k, Real full, std::size_t v) {
  if (!k.direction_ok[v]) return {};
  const Real a = std::abs(k.kmax[v]), b = std::abs(k.kmin[v]), large = std::max(a, b);
  if (!(large > 0)) return {};
  const Real confidence = (large - std::min(a, b)) / large * std::min(1.0, large / full);
  return line_tensor(a > b ? k.tmin[v] : k.tmax[v], confidence);
}

// Some unit vector orthogonal to n.
Vec3 tangent_of(const Vec3& n) {
  const Vec3 axis = std::abs(n.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
  return n.cross(axis).normalized();
}

Real percentile95(std::vector<float> values) {
  std::erase_if(values, [](float v) { return v <= 0; });
  if (values.empty()) return 1;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 95 / 100);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void normalise(std::vector<float>& values) {
  const float top = static_cast<float>(percentile95(values));
  for (float& v : values) v = std::min(1.0f, v / top);
}

}  // namespace

DirectionField direction_field(const Work& work, const MeshView& mesh, const CurvatureFields& fields,
                               const DirectionFieldOptions& options) {
  const std::size_t n = mesh.vertex_count();
  std::vector<Tensor> tensor(n), next(n);
  for_each(work, Cost::light, n, [&](std::size_t v) { tensor[v] = vertex_tensor(fields, options.full_confidence, v); });
  for (int round = 0; round < options.smoothing; ++round) {
    for_each(work, Cost::medium, n, [&](std::size_t v) {
      Tensor s = tensor[v];
      const auto ring = mesh.vertex_vertices.row(static_cast<Index>(v));
      for (Index w : ring)
        for (int i = 0; i < 6; ++i) s[i] += tensor[w][i];
      for (float& x : s) x /= static_cast<float>(ring.size() + 1);
      next[v] = s;
    });
    tensor.swap(next);
  }
  DirectionField field;
  field.direction.resize(n);
  field.confidence.resize(n), field.ridge.resize(n), field.valley.resize(n);
  for_each(work, Cost::medium, n, [&](std::size_t v) {
    const Vec3 normal = fields.normal[v], u = tangent_of(normal), w = normal.cross(u);
    const Vec3 mu = times(tensor[v], u), mw = times(tensor[v], w);
    const Real a = u.dot(mu), b = u.dot(mw), c = w.dot(mw);
    const Real q = std::hypot((a - c) / 2, b), phi = 0.5 * std::atan2(b, (a - c) / 2);
    field.direction.set(v, q > 0 ? Vec3(std::cos(phi) * u + std::sin(phi) * w) : Vec3(Vec3::Zero()));
    field.confidence[v] = static_cast<float>(std::min(1.0, 2 * q));  // mu_1 - mu_2: 1 for one certain direction
    field.ridge[v] = static_cast<float>(std::max(fields.kmax[v], 0.0));
    field.valley[v] = static_cast<float>(std::max(-fields.kmin[v], 0.0));
  });
  in_parallel([&] { normalise(field.ridge); }, [&] { normalise(field.valley); });
  return field;
}

}  // namespace intarsia::kernels
