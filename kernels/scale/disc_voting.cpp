#include "kernels/scale/disc_voting.h"

#include <algorithm>
#include <cmath>

#include "kernels/scale/lane_series.h"

namespace intarsia::kernels {

namespace {

constexpr std::size_t kPack = 8, kValues = 9;

// Of one cluster: where it is, and what makes distances into weights.
struct Disc {
  float x, y, z, inverse_radius, inverse_cell, edge;
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

const DiscVoting::Gathered& DiscVoting::samples_of(const DiscWalker::Place& place, Index cluster, int code) {
  Gathered& g = gathered_[static_cast<std::size_t>(code - kFirstDisc)];
  if (g.place.same_list(place)) return g;
  const DiscWalker::Samples samples = walker_.around(cluster, code);
  const SampleLevel& level = build_.levels.level[samples.level];
  const auto& tensor = build_.tensor[samples.level];
  g.place = place;
  g.size = (samples.id.size() + kPack - 1) / kPack;
  if (g.pack.size() < g.size) g.pack.resize(2 * g.size);
  g.origin = level.centre[samples.id[0]];
  const auto put = [&](std::size_t i, const Vec3& p, const Tensor& t) {
    auto& v = g.pack[i / kPack].value;
    for (int j = 0; j < 3; ++j) v[j][i % kPack] = static_cast<float>(p[j]);
    for (std::size_t j = 0; j < 6; ++j) v[3 + j][i % kPack] = static_cast<float>(t[j]);
  };
  for (std::size_t i = 0; i < samples.id.size(); ++i)
    put(i, level.centre[samples.id[i]] - g.origin, tensor[samples.id[i]]);
  for (std::size_t i = samples.id.size(); i < kPack * g.size; ++i) put(i, Vec3::Zero(), Tensor{});
  return g;
}

void DiscVoting::run(std::span<const Index> clusters, int code, std::span<Real> variation) {
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
      const DiscWalker::Place place = walker_.place(c, code);
      const Gathered& g = samples_of(place, c, code);
      const Vec3 at = build_.levels.level[0].centre[c] - g.origin;
      const Disc disc{static_cast<float>(at.x()),         static_cast<float>(at.y()),
                      static_cast<float>(at.z()),         static_cast<float>(1 / place.radius),
                      static_cast<float>(1 / place.cell), static_cast<float>(place.radius / place.cell + 0.5)};
      Sums sums;
      if (set_ == InstructionSet::avx512)
        avx512::sum_disc(disc, g.pack.data()->value[0], g.size, sums.of);
      else if (set_ == InstructionSet::avx2)
        avx2::sum_disc(disc, g.pack.data()->value[0], g.size, sums.of);
      else
        baseline::sum_disc(disc, g.pack.data()->value[0], g.size, sums.of);
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
