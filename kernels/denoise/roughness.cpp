#include "kernels/denoise/roughness.h"

#include <array>
#include <numbers>

#include "engine/parallel/reduce.h"

namespace intarsia::kernels {
namespace {

constexpr int kBins = 1800;  // of 0.1 degrees
using Histogram = std::array<Index, kBins>;

Histogram add(const Histogram& a, const Histogram& b) {
  Histogram sum;
  for (int i = 0; i < kBins; ++i) sum[i] = a[i] + b[i];
  return sum;
}

}  // namespace

Real roughness(const Work& work, const MeshView& mesh, Vec3View face_normal) {
  const auto count = [&](std::size_t begin, std::size_t end) {
    Histogram bins{};
    for (std::size_t f = begin; f < end; ++f) {
      const Vec3 n = face_normal[f];
      Vec3 around = Vec3::Zero();
      bool counts = n.squaredNorm() > 0;
      for (int i = 0; i < 3; ++i) {
        const Index e = mesh.face_edge[3 * f + i], g = mesh.other_face(e, static_cast<Index>(f));
        if (g == kNone)
          counts = false;
        else
          around += face_normal[g];
      }
      if (!counts || !(around.squaredNorm() > 0)) continue;
      const Real angle = std::atan2(n.cross(around).norm(), n.dot(around));
      ++bins[std::min(kBins - 1, static_cast<int>(angle * kBins / std::numbers::pi))];
    }
    return bins;
  };
  const Histogram bins = reduce(work, Cost::light, mesh.face_count(), Histogram{}, count, add);
  std::uint64_t all = 0, below = 0;
  for (const Index n : bins) all += n;
  if (all == 0) return 0;
  int bin = 0;
  while (2 * (below += bins[bin]) < all) ++bin;
  return (bin + 0.5) * std::numbers::pi / kBins;
}

}  // namespace intarsia::kernels
