#include "kernels/denoise/roughness.h"

#include <array>
#include <cmath>

#include "engine/parallel/reduce.h"

namespace intarsia::kernels {
namespace {

constexpr int kBins =
    1800;  // of the distance between unit normals, 2 sin(angle / 2): 0.06 degrees each where it is small
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
      const Real apart = (n - around.normalized()).norm();
      ++bins[std::min(kBins - 1, static_cast<int>(apart * (kBins / 2.0)))];
    }
    return bins;
  };
  const Histogram bins = reduce(work, Cost::light, mesh.face_count(), Histogram{}, count, add);
  std::uint64_t all = 0, below = 0;
  for (const Index n : bins) all += n;
  if (all == 0) return 0;
  int bin = 0;
  while (2 * (below += bins[bin]) < all) ++bin;
  return 2 * std::asin(std::min<Real>(1, (bin + 0.5) / kBins));
}

}  // namespace intarsia::kernels
