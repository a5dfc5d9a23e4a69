#include "kernels/baselines/vsa.h"

#include <algorithm>

#include "engine/parallel/for_each.h"
#include "kernels/baselines/exchange_regions.h"

namespace intarsia::kernels {
namespace {

constexpr int kBorderSteps = 3, kBorderRings = 3;

enum Start { gradual, farthest, merging_few, merging_many, starts };
constexpr Start kQuickest = merging_few;

// The best regions so far, and the ways to better ones that all starts share.
struct Search {
  const Work& work;
  const FaceGraph& graph;
  const VsaOptions& options;
  FaceQueue queue;
  NormalRegions now, best;
  Real best_energy = 0;
  std::vector<Real> history;

  Search(const Work& w, const FaceGraph& g, const VsaOptions& o) : work(w), graph(g), options(o) {}

  void keep_if_better() {
    const Real energy = now.total();
    history.push_back(energy);
    if (best.region.empty() || energy < best_energy) best = now, best_energy = energy;
  }
  void steps(int full, int borders) {
    for (int i = 0; i < full; ++i) {
      regrow(work, graph, now, queue, options.area_in_key);
      keep_if_better();
    }
    if (borders > 0) now = best;
    for (int i = 0; i < borders; ++i) {
      regrow_borders(work, graph, now, queue, kBorderRings);
      keep_if_better();
    }
  }
  void iterate() {
    const int round = options.teleport_every > 0 ? options.teleport_every : options.iterations;
    for (int done = 0; done < options.iterations; done += round) {
      const Real before = best_energy;
      now = best;
      if (options.teleport_every > 0 && teleport(work, graph, now, queue) > 0) keep_if_better();
      steps(std::min(round, options.iterations - done), kBorderSteps);
      if (!(best_energy < before * (1 - options.tolerance))) return;
    }
  }
};

// First regions, by each of the starts.
class Begin {
 public:
  Begin(Search& search, const PatchLabels& pieces) : s_(search), pieces_(pieces) {
    s_.now.region = pieces.patch_of_face;
    refit(s_.graph, s_.now, pieces.count);
  }

  void run(Start start) {
    const Index wanted = std::max(s_.options.patches, pieces_.count);
    switch (start) {
      case gradual:
        return add_to(wanted);
      case farthest:
        return insert_farthest(wanted);
      case merging_few:
        return merge_from(4 * wanted, wanted);
      default:
        return merge_from(12 * wanted, wanted);
    }
  }

 private:
  void step(int times) {
    for (int i = 0; i < times; ++i) regrow(s_.work, s_.graph, s_.now, s_.queue, s_.options.area_in_key);
  }
  bool split_to(Index wanted) {
    const Index before = s_.now.count();
    split_best(s_.work, s_.graph, s_.now, wanted, s_.queue);
    return s_.now.count() > before;
  }
  void merge_from(Index many, Index wanted) {
    while (s_.now.count() < many && split_to(many)) step(1);
    merge_cheapest(s_.work, s_.graph, s_.now, wanted);
  }
  // A few at a time where they gain most, with teleports between.
  void add_to(Index wanted) {
    while (s_.now.count() < wanted &&
           split_to(std::min(wanted, s_.now.count() + std::max(Index{1}, s_.now.count() / 12)))) {
      step(2);
      teleport(s_.work, s_.graph, s_.now, s_.queue);
      step(1);
    }
  }

  // Seeds one after the other at the face whose normal is farthest from all seeds so far, measured by the two-ring mean
  // so that no seed is spent on a single odd face.
  void insert_farthest(Index wanted) {
    const FaceGraph& g = s_.graph;
    const Index n = g.faces();
    std::vector<Vec3> smooth = g.normal, next(n);
    for (int ring = 0; ring < 2; ++ring) {
      for (Index f = 0; f < n; ++f) {
        Vec3 sum = g.area[f] * smooth[f];
        for (const Index o : g.around(f))
          if (o != kNone) sum += g.area[o] * smooth[o];
        next[f] = sum.isZero() ? sum : sum.normalized();
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
      for (const Index used : seed) gap[used] = -1;
    };
    for (Index f = 0; f < n; ++f)
      if (!seeded[pieces_.patch_of_face[f]]) insert(f);
    while (seed.size() < std::min(wanted, n)) {
      s_.work.check();
      insert(static_cast<Index>(std::max_element(gap.begin(), gap.end()) - gap.begin()));
    }
    grow_from(
        s_.work, g, seed, s_.now.region, s_.queue,
        [&](Index f, Index r) { return (g.normal[f] - smooth[seed[r]]).squaredNorm(); },
        [](Index, Index) { return true; });
    refit(g, s_.now, static_cast<Index>(seed.size()));
  }

  Search& s_;
  const PatchLabels& pieces_;
};

// Exchanges as long as they pay and the budget lasts.
void exchange_all(const Work& work, const FaceGraph& graph, const VsaOptions& options, Search& search) {
  constexpr std::size_t kFloods = 150;  // about what one round costs
  for (std::size_t spent = 0; spent < options.exchange_faces; spent += kFloods * graph.faces()) {
    search.now = search.best;
    if (exchange_regions(work, graph, search.now, {.tolerance = options.tolerance}) == 0) return;
    search.keep_if_better();
    search.iterate();
  }
}

}  // namespace

VsaFit fit_planes(const Work& work, const FaceGraph& graph, const VsaOptions& options) {
  // Starts and exchanges look at balls of faces where there are many: the borders are drawn by faces at the end.
  const Index wanted = std::max(Index{1}, options.patches);
  const Index size = graph.faces() / std::max(options.coarse_faces, 100 * wanted);
  const bool coarse = size > 1;
  const BallGraph balls = coarse ? gather_balls(work, graph, size) : BallGraph{};
  const FaceGraph& start = coarse ? balls.graph : graph;
  const PatchLabels pieces = connected_pieces(start);
  std::vector<Search> search(static_cast<std::size_t>(std::clamp(options.starts, 1, int{starts})),
                             Search(work, start, options));
  for_each(work, Cost::single, search.size(), [&](std::size_t i) {
    Begin(search[i], pieces).run(search.size() == 1 ? kQuickest : static_cast<Start>(i));
    search[i].keep_if_better();
    search[i].iterate();
  });
  Search& chosen = *std::min_element(search.begin(), search.end(),
                                     [](const Search& a, const Search& b) { return a.best_energy < b.best_energy; });
  exchange_all(work, start, options, chosen);
  VsaFit fit;
  const auto take = [&](Search& s) {
    fit.count = s.best.count(), fit.energy = s.best_energy;
    fit.region = std::move(s.best.region), fit.history = std::move(s.history);
  };
  if (coarse) {
    Search fine(work, graph, options);
    for (const Index b : balls.ball) fine.now.region.push_back(chosen.best.region[b]);
    refit(graph, fine.now, chosen.best.count());
    fine.keep_if_better();
    fine.iterate();
    take(fine);
  } else {
    take(chosen);
  }
  return fit;
}

}  // namespace intarsia::kernels
