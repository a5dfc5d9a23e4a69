#include "kernels/scale/select_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {

namespace {

int closest_ring(std::span<const Real> variation, const SelectOptions& o) {
  Real least = std::abs(variation[0] - o.bent);
  for (Real w : variation) least = std::min(least, std::abs(w - o.bent));
  int k = 0;
  while (std::abs(variation[k] - o.bent) > least + o.slack) ++k;
  return k + 1;
}

// "The maximum variation of omega_k, the ratio of omega_k and omega_(k+1)", to the letter.
int largest_drop(std::span<const Real> variation) {
  int best = 1;
  Real most = -1;
  for (std::size_t j = 0; j + 1 < variation.size(); ++j) {
    if (variation[j] == 0 && variation[j + 1] == 0) continue;
    const Real ratio = variation[j + 1] > 0 ? variation[j] / variation[j + 1] : std::numeric_limits<Real>::infinity();
    if (ratio > most) most = ratio, best = static_cast<int>(j) + 1;
  }
  return best;
}

// A rise means that ring j + 1 is the first to see the feature; a fall, that ring j is the last undiluted one.
int largest_jump(std::span<const Real> variation, const SelectOptions& o) {
  const Real eps = o.flat / 10;
  int best = 1;
  Real most = -1;
  for (std::size_t j = 0; j + 1 < variation.size(); ++j) {
    const Real change = std::log((variation[j + 1] + eps) / (variation[j] + eps));
    if (std::abs(change) > most) {
      most = std::abs(change);
      best = static_cast<int>(j) + (change > 0 ? 2 : 1);
    }
  }
  return best;
}

}  // namespace

Choice choose_ring(std::span<const Real> variation, const SelectOptions& o) {
  const std::size_t reached =
      static_cast<std::size_t>(std::count_if(variation.begin(), variation.end(), [&](Real w) { return w >= o.flat; }));
  if (2 * reached < variation.size()) return {1, Bend::flat};
  if (2 * reached > variation.size()) return {closest_ring(variation, o), Bend::bent};
  return {o.jump ? largest_jump(variation, o) : largest_drop(variation), Bend::between};
}

int choose_disc(std::span<const Real> variation, int first, const SelectOptions& o) {
  if (variation.empty()) return 0;
  const int at = closest_ring(variation, o) - 1;
  return variation[static_cast<std::size_t>(at)] >= o.flat ? first + at : 0;
}

void median_over_neighbours(const Work& work, CsrView neighbours, std::span<const std::uint8_t> in,
                            std::span<std::uint8_t> out) {
  for_each(work, Cost::light, in.size(), [&](std::size_t v) {
    std::array<Index, 32> count{};
    Index total = 0;
    std::uint8_t most = in[v];
    const auto add = [&](std::uint8_t code) {
      if (code == 0) return;
      ++count[code], ++total;
      most = std::max(most, code);
    };
    if (in[v] == 0) {
      out[v] = 0;
      return;
    }
    add(in[v]);
    for (Index w : neighbours.row(static_cast<Index>(v))) add(in[w]);
    Index below = 0;
    std::uint8_t code = 0;
    while (below < (total + 1) / 2) below += count[++code];
    out[v] = code;
  });
}

}  // namespace intarsia::kernels
