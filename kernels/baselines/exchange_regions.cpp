#include "kernels/baselines/exchange_regions.h"

#include <algorithm>
#include <numeric>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {
namespace {

constexpr Index kFresh = kNone - 1;  // the region a cut makes, before it has a number

// A cut or a merge and its neighbourhood afterwards.
struct Change {
  std::vector<Index> regions;  // all whose faces may change, ascending
  std::vector<Index> faces, label;
  std::vector<Index> first;  // per face: its number right after the change, before any step; kNone: as it was
  Real change = 0;           // of the energy
  Index source = kNone;      // region that is cut, or that takes in the other
  Index gone = kNone;        // number that a merge frees
};

class Exchange {
 public:
  Exchange(const Work& work, const FaceGraph& graph, const NormalRegions& regions, const ExchangeOptions& options)
      : work_(work), graph_(graph), now_(regions), options_(options), around_(regions.count()) {
    PatchLabels labels;
    labels.patch_of_face = regions.region, labels.count = regions.count();
    faces_ = faces_of_patches(labels);
    for (const auto& [a, b] : adjacent_regions(graph, regions.region)) around_[a].push_back(b), around_[b].push_back(a);
    for (auto& row : around_) std::sort(row.begin(), row.end());
  }

  std::vector<Change> cuts() const {
    FaceQueue queue;
    const Halves cut = cut_in_two(work_, graph_, now_, queue);
    std::vector<Change> changes(now_.count());
    for_each(work_, Cost::single, changes.size(), [&](std::size_t r) {
      const Index region = static_cast<Index>(r);
      if (cut.gain[r] >= 0)
        changes[r] = adapt({region}, [&](Index f) { return now_.region[f] == region && cut.side[f] ? kFresh : kNone; });
    });
    return changes;
  }

  // Of every region the cheapest merge.
  std::vector<Change> merges() const {
    std::vector<Merge> chosen;
    std::vector<std::uint8_t> has(now_.count(), 0);
    for (const Merge& m : merges_by_loss(graph_, now_))
      if (!has[m.a] || !has[m.b]) has[m.a] = has[m.b] = 1, chosen.push_back(m);
    std::vector<Change> changes(chosen.size());
    for_each(work_, Cost::single, changes.size(), [&](std::size_t i) {
      const Merge m = chosen[i];
      changes[i] = adapt({m.a, m.b}, [&](Index f) { return now_.region[f] == m.b ? m.a : kNone; });
      changes[i].gone = m.b;
    });
    return changes;
  }

  // Both from where the regions stand now, then steps of all of them. The cut's region must not be merged as well.
  NormalRegions move(const Change& cut, const Change& merge) const {
    NormalRegions best = now_;
    if (cut.source != merge.gone && cut.source != merge.source) {
      for (std::size_t i = 0; i < cut.faces.size(); ++i)
        if (cut.first[i] != kNone) best.region[cut.faces[i]] = merge.gone;
      for (std::size_t i = 0; i < merge.faces.size(); ++i)
        if (merge.first[i] != kNone) best.region[merge.faces[i]] = merge.source;
      refit(graph_, best, best.count());
      FaceQueue queue;
      run_steps(work_, graph_, best, queue, 2 * options_.steps);
    }
    return best;
  }

 private:
  // Ends with the best of all steps.
  static void run_steps(const Work& work, const FaceGraph& graph, NormalRegions& best, FaceQueue& queue, int steps) {
    NormalRegions now = best;
    for (int i = 0; i <= steps; ++i) {
      if (i < steps)
        regrow(work, graph, now, queue, false);
      else
        now = best, regrow_borders(work, graph, now, queue, 3);
      if (now.total() < best.total()) best = now;
    }
  }

  // Lloyd steps on the regions `centre` and those around them, after relabelling: the new number of a face, or kNone.
  template <class Relabel>
  Change adapt(const std::vector<Index>& centre, const Relabel& relabel) const {
    Change c;
    c.regions = centre, c.source = centre[0];
    for (const Index r : centre) c.regions.insert(c.regions.end(), around_[r].begin(), around_[r].end());
    std::sort(c.regions.begin(), c.regions.end());
    c.regions.erase(std::unique(c.regions.begin(), c.regions.end()), c.regions.end());
    Real before = 0;
    for (const Index r : c.regions) {
      c.faces.insert(c.faces.end(), faces_.row(r).begin(), faces_.row(r).end());
      before += now_.energy(r);
    }
    const FaceGraph local = subgraph(graph_, c.faces);
    std::vector<Index> name;  // of a local region
    NormalRegions best;
    for (const Index f : c.faces) {
      const Index fresh = relabel(f);
      c.first.push_back(fresh);
      const Index r = fresh == kNone ? now_.region[f] : fresh;
      auto at = std::find(name.begin(), name.end(), r);
      if (at == name.end()) name.push_back(r), at = name.end() - 1;
      best.region.push_back(static_cast<Index>(at - name.begin()));
    }
    refit(local, best, static_cast<Index>(name.size()));
    FaceQueue queue;
    run_steps(work_, local, best, queue, options_.steps);
    c.change = best.total() - before;
    for (const Index l : best.region) c.label.push_back(name[l]);
    return c;
  }

  const Work& work_;
  const FaceGraph& graph_;
  const NormalRegions& now_;
  const ExchangeOptions& options_;
  Csr faces_;
  std::vector<std::vector<Index>> around_;
};

bool touches(const Change& c, const std::vector<std::uint8_t>& used) {
  return std::any_of(c.regions.begin(), c.regions.end(), [&](Index r) { return used[r]; });
}

bool disjoint(const Change& a, const Change& b) {
  std::vector<Index> common;
  std::set_intersection(a.regions.begin(), a.regions.end(), b.regions.begin(), b.regions.end(),
                        std::back_inserter(common));
  return common.empty();
}

std::vector<Index> order_by_change(const std::vector<Change>& changes) {
  std::vector<Index> order(changes.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return std::tie(changes[a].change, a) < std::tie(changes[b].change, b); });
  return order;
}

}  // namespace

Index exchange_regions(const Work& work, const FaceGraph& graph, NormalRegions& regions,
                       const ExchangeOptions& options) {
  const Exchange exchange(work, graph, regions, options);
  const std::vector<Change> cuts = exchange.cuts(), merges = exchange.merges();
  const std::vector<Index> cut_order = order_by_change(cuts);
  const Real least = options.tolerance * regions.total();
  std::vector<std::uint8_t> used(regions.count(), 0);
  Index done = 0;
  const auto apply = [](const Change& c, Index fresh, std::vector<Index>& region) {
    for (std::size_t i = 0; i < c.faces.size(); ++i) region[c.faces[i]] = c.label[i] == kFresh ? fresh : c.label[i];
  };
  std::vector<std::tuple<Real, Index, Index>> close;  // gains that may not add up, as the two are neighbours
  for (const Index m : order_by_change(merges)) {
    bool free = !touches(merges[m], used);
    for (const Index c : cut_order) {
      const Real gain = cuts[c].change + merges[m].change;
      if (!(gain < -least)) break;
      if (!disjoint(cuts[c], merges[m])) {
        close.emplace_back(gain, m, c);
      } else if (free && !touches(cuts[c], used)) {
        apply(merges[m], kNone, regions.region);
        apply(cuts[c], merges[m].gone, regions.region);
        for (const Change* x : {&merges[m], &cuts[c]})
          for (const Index r : x->regions) used[r] = 1;
        ++done;
        free = false;
      }
    }
  }
  if (done > 0) {
    refit(graph, regions, regions.count());
    return done;
  }
  std::sort(close.begin(), close.end());
  close.resize(std::min(close.size(), options.tries));
  std::vector<NormalRegions> tried(close.size());
  for_each(work, Cost::single, close.size(), [&](std::size_t i) {
    const auto [gain, m, c] = close[i];
    tried[i] = exchange.move(cuts[c], merges[m]);
  });
  const NormalRegions* best = nullptr;
  for (const NormalRegions& t : tried)
    if (t.total() < (best ? best->total() : regions.total() - least)) best = &t;
  if (!best) return 0;
  regions = *best;
  return 1;
}

}  // namespace intarsia::kernels
