#include "kernels/scale/disc_voting.h"

#include <algorithm>
#include <cmath>

#include "kernels/scale/lane_series.h"

namespace intarsia::kernels {

namespace {

constexpr std::size_t kPack = SampleTiles::kPack;

// Of one cluster: what makes distances into weights.
struct Disc {
  float inverse_radius, inverse_cell, edge;
};

namespace baseline {
constexpr std::size_t kWidth = 2;
#include "kernels/scale/disc_voting.inc"
}  // namespace baseline
INTARSIA_BEGIN_AVX2
constexpr std::size_t kWidth = 4;
#include "kernels/scale/disc_voting.inc"
INTARSIA_END_SET
INTARSIA_BEGIN_AVX512
constexpr std::size_t kWidth = 8;
#include "kernels/scale/disc_voting.inc"
INTARSIA_END_SET

}  // namespace

void DiscVoting::run(std::span<const Index> clusters, std::span<const Vec3> centres, int code,
                     std::span<Real> variation) {
  struct alignas(64) Sums {
    float of[6 * kPack];
  };
  struct alignas(64) Tensors {
    Real of[6 * kPack] = {}, omega[kPack];
  };
  Tensors tensors;
  for (std::size_t begin = 0; begin < clusters.size(); begin += kPack) {
    const std::size_t count = std::min(kPack, clusters.size() - begin);
    for (std::size_t l = 0; l < count; ++l) {
      const Index c = clusters[begin + l];
      const Vec3 centre = centres.empty() ? build_.levels.level[0].centre[c] : centres[begin + l];
      const DiscSamples::View samples = samples_.around(c, code, centre, skip_);
      if (samples.packs == 0) {
        for (std::size_t i = 0; i < 6; ++i) tensors.of[kPack * i + l] = 0;
        continue;
      }
      const Disc disc{static_cast<float>(1 / samples.radius), static_cast<float>(1 / samples.cell),
                      static_cast<float>(samples.radius / samples.cell + 0.5)};
      Sums sums;
      if (set_ == InstructionSet::avx512)
        avx512::sum_disc(disc, samples, sums.of);
      else if (set_ == InstructionSet::avx2)
        avx2::sum_disc(disc, samples, sums.of);
      else
        baseline::sum_disc(disc, samples, sums.of);
      for (std::size_t i = 0; i < 6; ++i) {
        const float* s = sums.of + kPack * i;
        tensors.of[kPack * i + l] =
            ((Real{s[0]} + s[4]) + (Real{s[2]} + s[6])) + ((Real{s[1]} + s[5]) + (Real{s[3]} + s[7]));
      }
    }
    if (set_ == InstructionSet::avx512)
      avx512::variations(tensors.of, tensors.omega);
    else if (set_ == InstructionSet::avx2)
      avx2::variations(tensors.of, tensors.omega);
    else
      baseline::variations(tensors.of, tensors.omega);
    std::copy_n(tensors.omega, count, variation.begin() + static_cast<std::ptrdiff_t>(begin));
  }
}

}  // namespace intarsia::kernels
