#include "kernels/baselines/qse.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "engine/parallel/for_each.h"
#include "kernels/baselines/normal_regions.h"
#include "kernels/baselines/vsa.h"

namespace intarsia::kernels {
namespace {

// Regions by number, with the quadric of each and its error.
struct State {
  std::vector<Index> region;
  std::vector<std::vector<Index>> faces;  // per region, ascending
  std::vector<Quadric> quadric;
  std::vector<Real> area;
  std::vector<Real> energy;  // area times mean error

  Index count() const { return static_cast<Index>(faces.size()); }
  Real total() const { return std::accumulate(energy.begin(), energy.end(), Real{0}); }
};

class Fit {
 public:
  Fit(const Work& work, const MeshView& mesh, const FaceGraph& graph, const QseOptions& options)
      : work_(work), mesh_(mesh), graph_(graph), options_(options) {
    Real area = 0;
    for (const Real a : graph.area) area += a;
    quadric_.normal_weight = options.normal_weight * area / std::max(Index{1}, options.patches);
  }

  QseFit run() {
    VsaOptions planes;
    planes.patches = options_.patches * std::max(Index{1}, options_.overshoot);
    planes.iterations = 10;
    VsaFit start = fit_planes(work_, graph_, planes);
    now_.region = std::move(start.region);
    refit(now_, start.count);
    const Index wanted = std::max(options_.patches, connected_pieces(graph_).count);
    while (now_.count() > wanted && merge_round(now_.count() - wanted)) {
    }
    iterate(options_.teleport_every > 0);
    if (options_.same_within > 0) {
      now_ = best_;
      bool merged = false;
      while (merge_round(now_.count() - 1, options_.same_within)) merged = true;
      if (merged) best_ = State{}, iterate(false);
    }
    QseFit fit;
    fit.region = std::move(best_.region), fit.quadric = std::move(best_.quadric), fit.energy = best_.total();
    return fit;
  }

 private:
  QuadricSample sample(Index f) const {
    const auto [a, b, c] = mesh_.face(f);
    return {{mesh_.point(a), mesh_.point(b), mesh_.point(c)}, graph_.normal[f], graph_.area[f]};
  }

  struct Fitted {
    Quadric quadric;
    Real area, energy;
  };
  // At most options.samples faces, evenly spread over the lists (face numbers follow a space-filling order).
  Fitted fit_lists(std::initializer_list<std::span<const Index>> lists) const {
    std::size_t total = 0;
    Real area = 0;
    for (const auto& list : lists) total += list.size();
    const std::size_t step = std::max<std::size_t>(1, total / options_.samples);
    std::vector<QuadricSample> samples;
    samples.reserve(total / step + 1);
    std::size_t i = 0;
    for (const auto& list : lists)
      for (const Index f : list) {
        area += graph_.area[f];
        if (i++ % step == 0) samples.push_back(sample(f));
      }
    Fitted r;
    r.quadric = fit_quadric(samples, quadric_);
    r.area = area;
    r.energy = area * quadric_error(r.quadric, samples, quadric_.normal_weight);
    return r;
  }

  void refit(State& s, Index count) const {
    s.faces.assign(count, {});
    for (Index f = 0; f < graph_.faces(); ++f) s.faces[s.region[f]].push_back(f);
    s.quadric.resize(count), s.area.resize(count), s.energy.resize(count);
    for_each(work_, Cost::single, count, [&](std::size_t r) {
      const Fitted fit = fit_lists({s.faces[r]});
      s.quadric[r] = fit.quadric, s.area[r] = fit.area, s.energy[r] = fit.energy;
    });
  }

  void regrow() {
    const Index count = now_.count();
    std::vector<Index> seed(count, kNone);
    for_each(work_, Cost::single, count, [&](std::size_t r) {  // best fit; of equal ones the nearest to the middle
      const Vec3 middle = now_.quadric[r].origin;
      Real best = std::numeric_limits<Real>::infinity(), nearest = best;
      for (const Index f : now_.faces[r]) {
        const Real e = std::max(1e-12, key(f, static_cast<Index>(r)));
        const Real away = (graph_.centroid[f] - middle).squaredNorm();
        if (std::tie(e, away) < std::tie(best, nearest)) best = e, nearest = away, seed[r] = f;
      }
    });
    grow_from(
        work_, graph_, seed, now_.region, queue_, [&](Index f, Index r) { return key(f, r); },
        [](Index, Index) { return true; });
    refit(now_, count);
  }
  Real key(Index f, Index r) const { return quadric_error(now_.quadric[r], sample(f), quadric_.normal_weight); }

  struct Move {
    Real loss;
    Index a, b;
    bool operator<(const Move& o) const { return std::tie(loss, a, b) < std::tie(o.loss, o.a, o.b); }
  };
  std::vector<Move> merges() const {
    const auto pairs = adjacent_regions(graph_, now_.region);
    std::vector<Move> moves(pairs.size());
    for_each(work_, Cost::single, pairs.size(), [&](std::size_t i) {
      const auto [a, b] = pairs[i];
      moves[i] = {fit_lists({now_.faces[a], now_.faces[b]}).energy - now_.energy[a] - now_.energy[b], a, b};
    });
    std::sort(moves.begin(), moves.end());
    return moves;
  }

  // The cheapest merges, a fifth of all at once at most, each region in one only. within: only if the error (root mean
  // square) of the union stays below.
  bool merge_round(Index most, Real within = std::numeric_limits<Real>::infinity()) {
    const std::vector<Move> moves = merges();
    const Index limit = std::min(most, std::max(Index{1}, now_.count() / 5));
    std::vector<Index> into(now_.count());
    std::iota(into.begin(), into.end(), Index{0});
    std::vector<std::uint8_t> used(now_.count(), 0);
    Index done = 0;
    for (const Move& m : moves) {
      if (done == limit) break;
      if (used[m.a] || used[m.b]) continue;
      const Real energy = m.loss + now_.energy[m.a] + now_.energy[m.b];
      if (!(energy <= within * within * (now_.area[m.a] + now_.area[m.b]))) continue;
      used[m.a] = used[m.b] = 1;
      into[m.b] = m.a;
      ++done;
    }
    if (done == 0) return false;
    Index count = 0;
    std::vector<Index> fresh(now_.count());
    for (Index r = 0; r < now_.count(); ++r)
      if (into[r] == r) fresh[r] = count++;
    for (Index& r : now_.region) r = fresh[into[r]];
    refit(now_, count);
    return true;
  }

  // As teleport() of planes: a merged pair pays for a cut elsewhere.
  bool teleport() {
    const Index count = now_.count();
    NormalRegions normals;
    normals.region = now_.region;
    kernels::refit(graph_, normals, count);
    const Halves cut = cut_in_two(work_, graph_, normals, queue_);
    std::vector<Real> gain(count, -1);
    for_each(work_, Cost::single, count, [&](std::size_t r) {
      if (cut.gain[r] < 0) return;
      std::vector<Index> half[2];
      for (const Index f : now_.faces[r]) half[cut.side[f]].push_back(f);
      gain[r] = now_.energy[r] - fit_lists({half[0]}).energy - fit_lists({half[1]}).energy;
    });
    std::vector<Index> by_gain(count);
    std::iota(by_gain.begin(), by_gain.end(), Index{0});
    std::sort(by_gain.begin(), by_gain.end(),
              [&](Index a, Index b) { return std::tuple(-gain[a], a) < std::tuple(-gain[b], b); });
    std::vector<std::uint8_t> used(count, 0);
    std::vector<Index> into(count, kNone), other(count, kNone);
    bool moved = false;
    for (const Move& m : merges()) {
      if (used[m.a] || used[m.b]) continue;
      const auto target =
          std::find_if(by_gain.begin(), by_gain.end(), [&](Index r) { return !used[r] && r != m.a && r != m.b; });
      if (target == by_gain.end() || !(gain[*target] > m.loss * 1.01 + 1e-12)) break;
      used[m.a] = used[m.b] = used[*target] = 1;
      into[m.b] = m.a, other[*target] = m.b;
      moved = true;
    }
    if (!moved) return false;
    for (Index f = 0; f < graph_.faces(); ++f) {
      Index& r = now_.region[f];
      if (into[r] != kNone)
        r = into[r];
      else if (other[r] != kNone && cut.side[f])
        r = other[r];
    }
    refit(now_, count);
    return true;
  }

  void keep_if_better() {
    if (best_.region.empty() || now_.total() < best_.total()) best_ = now_;
  }

  void iterate(bool teleports) {
    keep_if_better();
    const int round = options_.teleport_every > 0 ? options_.teleport_every : options_.iterations;
    for (int done = 0; done < options_.iterations; done += round) {
      const Real before = best_.total();
      now_ = best_;
      if (teleports && teleport()) keep_if_better();
      for (int i = 0; i < std::min(round, options_.iterations - done); ++i) {
        regrow();
        keep_if_better();
      }
      if (!(best_.total() < before * (1 - options_.tolerance))) return;
    }
  }

  const Work& work_;
  const MeshView& mesh_;
  const FaceGraph& graph_;
  const QseOptions& options_;
  QuadricOptions quadric_;
  FaceQueue queue_;
  State now_, best_;
};

}  // namespace

QseFit fit_quadrics(const Work& work, const MeshView& mesh, const FaceGraph& graph, const QseOptions& options) {
  return Fit(work, mesh, graph, options).run();
}

}  // namespace intarsia::kernels
