#include "kernels/denoise/remove_details.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/for_each.h"
#include "kernels/denoise/fit_positions.h"
#include "kernels/denoise/triangles.h"

namespace intarsia::kernels {
namespace {

// One step of diffusion over the neighbours across edges. weight(f, g): how much g counts for f.
template <class Weight>
void diffuse(const Work& work, const MeshView& mesh, std::span<const Real> area, const Weight& weight,
             Vec3Array& normal, Vec3Array& next) {
  for_each(work, Cost::medium, mesh.face_count(), [&](std::size_t i) {
    const Index f = static_cast<Index>(i);
    Vec3 sum = area[f] * normal[f];
    for (int k = 0; k < 3; ++k) {
      const Index g = mesh.other_face(mesh.face_edge[3 * i + static_cast<std::size_t>(k)], f);
      if (g != kNone) sum += area[g] * weight(f, g) * normal[g];
    }
    const Real length = sum.norm();
    next.set(f, length > 0 ? Vec3(sum / length) : normal[f]);
  });
  std::swap(normal, next);
}

}  // namespace

Vec3Array remove_details(const Work& work, const MeshView& mesh, Real size, Real mean_edge,
                         const DetailOptions& options) {
  // Diffusion over n steps of about 0.6 edges each spreads to 0.6 sqrt(n) edges: a standard deviation of half the size.
  constexpr Real kStep = 0.6;
  constexpr int kMost = 400;
  const Real spread = size / 2 / (kStep * mean_edge);
  const int steps = std::clamp(static_cast<int>(spread * spread), 1, kMost);
  Vec3Array position = positions_of(work, mesh);
  const Triangles given = triangles_of(work, mesh, position);
  Vec3Array guide = given.normal, next(mesh.face_count()), normal;
  for (int i = 0; i < steps; ++i)
    diffuse(
        work, mesh, given.area, [](Index, Index) { return Real(1); }, guide, next);
  for (int round = 0; round < options.rounds; ++round) {
    normal = given.normal;
    const auto alike = [&](Index f, Index g) {
      return std::exp(-(guide[f] - guide[g]).squaredNorm() / (2 * options.sigma * options.sigma));
    };
    for (int i = 0; i < steps; ++i) diffuse(work, mesh, given.area, alike, normal, next);
    guide = normal;
  }
  fit_positions(work, mesh, normal, std::max(20, steps), size, position);
  return position;
}

}  // namespace intarsia::kernels
