#include "kernels/baselines/vsa.h"

#include <algorithm>
#include <array>

#include "engine/parallel/for_each.h"
#include "kernels/baselines/normal_regions.h"

namespace intarsia::kernels {
namespace {

constexpr int kBorderSteps = 3, kBorderRings = 3;

enum Start { halving, farthest, merging };

class Fit {
 public:
  Fit(const Work& work, const FaceGraph& graph, const VsaOptions& options, const PatchLabels& pieces)
      : work_(work), graph_(graph), options_(options), pieces_(pieces) {}

  VsaFit run(Start start) {
    now_.region = pieces_.patch_of_face;
    refit(graph_, now_, pieces_.count);
    const Index wanted = std::max(options_.patches, pieces_.count);
    if (start == halving) {
      halve_to(wanted, 3);
    } else if (start == merging) {
      halve_to(options_.overshoot * wanted, 1);
      merge_cheapest(work_, graph_, now_, wanted);
    } else {
      insert_farthest(wanted);
    }
    iterate();
    VsaFit fit;
    fit.region = std::move(best_.region);
    fit.count = static_cast<Index>(best_.area.size());
    fit.energy = best_energy_;
    fit.history = std::move(history_);
    return fit;
  }

 private:
  void halve_to(Index wanted, int steps) {
    while (now_.count() < wanted) {
      const Index before = now_.count();
      split_best(work_, graph_, now_, wanted, queue_);
      if (now_.count() == before) return;
      for (int i = 0; i < steps; ++i) regrow(work_, graph_, now_, queue_, options_.area_in_key);
    }
  }

  // Seeds one after the other at the face whose normal is farthest from all seeds so far, measured by the two-ring mean
  // so that no seed is spent on a single odd face.
  void insert_farthest(Index wanted) {
    const Index n = graph_.faces();
    std::vector<Vec3> smooth = graph_.normal, next(n);
    for (int ring = 0; ring < 2; ++ring) {
      for (Index f = 0; f < n; ++f) {
        Vec3 s = graph_.area[f] * smooth[f];
        for (const Index o : graph_.around(f))
          if (o != kNone) s += graph_.area[o] * smooth[o];
        next[f] = s.isZero() ? s : s.normalized();
      }
      smooth.swap(next);
    }
    std::vector<Index> seed;
    std::vector<Real> gap(n, 8);
    std::vector<std::uint8_t> seeded(pieces_.count, 0);
    const auto insert = [&](Index f) {
      seed.push_back(f);
      seeded[pieces_.patch_of_face[f]] = 1;
      for (Index o = 0; o < n; ++o) gap[o] = std::min(gap[o], (smooth[o] - smooth[f]).squaredNorm());
      gap[f] = -1;
    };
    for (Index f = 0; f < n; ++f)
      if (!seeded[pieces_.patch_of_face[f]]) insert(f);
    while (seed.size() < std::min(wanted, n)) {
      work_.check();
      insert(static_cast<Index>(std::max_element(gap.begin(), gap.end()) - gap.begin()));
    }
    grow_from(
        work_, graph_, seed, now_.region, queue_,
        [&](Index f, Index r) { return (graph_.normal[f] - smooth[seed[r]]).squaredNorm(); },
        [](Index, Index) { return true; });
    refit(graph_, now_, static_cast<Index>(seed.size()));
  }

  void keep_if_better() {
    const Real energy = now_.total();
    history_.push_back(energy);
    if (best_.region.empty() || energy < best_energy_) best_ = now_, best_energy_ = energy;
  }

  void iterate() {
    keep_if_better();
    const int round = options_.teleport_every > 0 ? options_.teleport_every : options_.iterations;
    for (int done = 0; done < options_.iterations; done += round) {
      const Real before = best_energy_;
      now_ = best_;
      if (options_.teleport_every > 0 && teleport(work_, graph_, now_, queue_) > 0) keep_if_better();
      for (int i = 0; i < std::min(round, options_.iterations - done); ++i) {
        regrow(work_, graph_, now_, queue_, options_.area_in_key);
        keep_if_better();
      }
      now_ = best_;
      for (int i = 0; i < kBorderSteps; ++i) {
        regrow_borders(work_, graph_, now_, queue_, kBorderRings);
        keep_if_better();
      }
      if (!(best_energy_ < before * (1 - options_.tolerance))) return;
    }
  }

  const Work& work_;
  const FaceGraph& graph_;
  const VsaOptions& options_;
  const PatchLabels& pieces_;
  FaceQueue queue_;
  NormalRegions now_, best_;
  Real best_energy_ = 0;
  std::vector<Real> history_;
};

}  // namespace

VsaFit fit_planes(const Work& work, const FaceGraph& graph, const VsaOptions& options) {
  const PatchLabels pieces = connected_pieces(graph);
  std::array<VsaFit, 3> fit;
  for_each(work, Cost::single, fit.size(),
           [&](std::size_t i) { fit[i] = Fit(work, graph, options, pieces).run(static_cast<Start>(i)); });
  return std::move(
      *std::min_element(fit.begin(), fit.end(), [](const VsaFit& a, const VsaFit& b) { return a.energy < b.energy; }));
}

}  // namespace intarsia::kernels
