#include "kernels/baselines/slippage_segments.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>

#include "engine/parallel/for_each.h"
#include "kernels/baselines/face_queue.h"
#include "kernels/baselines/slippage.h"

namespace intarsia::kernels {
namespace {

class Segments {
 public:
  Segments(const Work& work, const FaceGraph& faces, const SlippageOptions& options)
      : work_(work), faces_(faces), options_(options) {
    const Index size = std::max(Index{1}, faces.faces() / std::max(options.pieces, 20 * options.patches));
    balls_ = gather_balls(work, faces, size);
    sums_.resize(balls_.graph.faces());
    for (Index f = 0; f < faces.faces(); ++f)
      sums_[balls_.ball[f]].add(faces.area[f], faces.centroid[f], faces.normal[f]);
  }

  PatchLabels run() {
    analyse();
    grow_first_patches();
    merge();
    return sharpen();
  }

 private:
  // Motions of every ball's neighbourhood, grown until they are certain.
  void analyse() {
    const FaceGraph& g = balls_.graph;
    dimension_.resize(g.faces()), certainty_.resize(g.faces());
    for_each_block(work_, Cost::heavy, g.faces(), [&](std::size_t begin, std::size_t end, std::size_t) {
      std::vector<Index> ring, seen(g.faces(), kNone);
      for (std::size_t i = begin; i < end; ++i) {
        const Index b = static_cast<Index>(i);
        ring.assign(1, b), seen[b] = b;
        SlippageSums sums = sums_[b];
        Real condition = 0;
        std::size_t at = 0;
        for (const std::size_t size : {12, 24, 48, 96}) {
          for (; at < ring.size() && ring.size() < size; ++at)
            for (const Index o : g.around(ring[at]))
              if (o != kNone && seen[o] != b) seen[o] = b, ring.push_back(o), sums += sums_[o];
          const Slippage s = slippage_of(sums);
          const Real now = s.value[0] / std::max(s.value[5], 1e-300);
          dimension_[b] = s.dimension(options_.limit);
          certainty_[b] = now;
          if (std::abs(now - condition) <= options_.stable * std::max(now, condition)) break;
          condition = now;
        }
      }
    });
  }

  // From the most certain ball outward, over balls that slip in as many ways, while the motions stay common to all.
  void grow_first_patches() {
    const FaceGraph& g = balls_.graph;
    patch_.assign(g.faces(), kNone);
    std::vector<Index> order(g.faces());
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      return std::tuple(-dimension_[a], certainty_[a], a) < std::tuple(-dimension_[b], certainty_[b], b);
    });
    std::vector<Index> front;
    for (const Index seed : order) {
      if (patch_[seed] != kNone) continue;
      work_.check();
      const Index id = static_cast<Index>(sum_.size());
      const int d = std::min(3, dimension_[seed]);
      SlippageSums sum = sums_[seed];
      patch_[seed] = id;
      front.assign(1, seed);
      for (std::size_t i = 0; d > 0 && i < front.size(); ++i)
        for (const Index o : g.around(front[i])) {
          if (o == kNone || patch_[o] != kNone || std::min(3, dimension_[o]) != d) continue;
          SlippageSums both = sum;
          both += sums_[o];
          const Slippage s = slippage_of(both);
          if (s.error(d) > options_.growth * s.value[5]) continue;
          sum = both;
          patch_[o] = id;
          front.push_back(o);
        }
      sum_.push_back(sum);
    }
  }

  struct Candidate {
    Real cost;
    Index a, b;
    std::uint32_t version;                      // of both together
    bool operator<(const Candidate& o) const {  // the queue gives the greatest first
      return std::tie(cost, a, b, version) > std::tie(o.cost, o.a, o.b, o.version);
    }
  };

  // What the motions of the more slippable of the two come to if they must serve both; a motion that is lost costs a
  // fixed sum. Weighed by the harmonic mean of the areas: small patches find their way into large ones first.
  Real cost_of(Index a, Index b) const {
    const int motions = std::clamp(std::max(kind_[a], kind_[b]), 1, 3);
    SlippageSums both = sum_[a];
    both += sum_[b];
    const Slippage s = slippage_of(both);
    Real cost = 0;
    for (int j = 0; j < motions; ++j) cost += std::min(s.value[j], options_.lost * s.value[5]);
    return both.weight > 0 ? cost / std::max(s.value[5], 1e-300) * sum_[a].weight * sum_[b].weight / both.weight : 0;
  }
  void describe(Index p) { kind_[p] = slippage_of(sum_[p]).dimension(options_.limit); }

  void merge() {
    const Index count = static_cast<Index>(sum_.size());
    kind_.resize(count);
    for (Index p = 0; p < count; ++p) describe(p);
    std::vector<std::vector<Index>> around(count);
    const auto pairs = adjacent_regions(balls_.graph, patch_);
    std::vector<std::uint32_t> version(count, 0);
    std::vector<Real> cost(pairs.size());
    for_each(work_, Cost::heavy, pairs.size(), [&](std::size_t i) { cost[i] = cost_of(pairs[i][0], pairs[i][1]); });
    std::priority_queue<Candidate> queue;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto [a, b] = pairs[i];
      around[a].push_back(b), around[b].push_back(a);
      queue.push({cost[i], a, b, 0});
    }
    into_.resize(count);
    std::iota(into_.begin(), into_.end(), Index{0});
    for (Index left = count; left > std::max(Index{1}, options_.patches) && !queue.empty();) {
      const Candidate c = queue.top();
      queue.pop();
      if (into_[c.a] != c.a || into_[c.b] != c.b || version[c.a] + version[c.b] != c.version) continue;
      if (left-- % 64 == 0) work_.check();
      into_[c.b] = c.a;
      sum_[c.a] += sum_[c.b];
      ++version[c.a];
      describe(c.a);
      auto& near = around[c.a];
      near.insert(near.end(), around[c.b].begin(), around[c.b].end());
      for (Index& o : near) o = into_[o];
      std::sort(near.begin(), near.end());
      near.erase(std::unique(near.begin(), near.end()), near.end());
      std::erase(near, c.a);
      for (const Index o : near) {
        auto& back = around[o];
        std::replace(back.begin(), back.end(), c.b, c.a);
        const Index low = std::min(o, c.a), high = std::max(o, c.a);
        queue.push({cost_of(low, high), low, high, version[low] + version[high]});
      }
    }
    for (Index p = 0; p < count; ++p)
      while (into_[p] != into_[into_[p]]) into_[p] = into_[into_[p]];
  }

  // Borders by faces: those near another patch go where their own motion along the normal is least.
  PatchLabels sharpen() {
    constexpr int kRings = 2;
    std::vector<Index> region(faces_.faces());
    for (Index f = 0; f < faces_.faces(); ++f) region[f] = into_[patch_[balls_.ball[f]]];
    std::vector<Slippage> slip(sum_.size());
    for (Index p = 0; p < sum_.size(); ++p)
      if (into_[p] == p) slip[p] = slippage_of(sum_[p]);
    std::vector<Index> core = region;
    for (int ring = 0; ring < kRings; ++ring) {
      const std::vector<Index> before = core;
      for (Index f = 0; f < faces_.faces(); ++f)
        for (const Index o : faces_.around(f))
          if (o != kNone && before[o] != before[f]) core[f] = kNone;
    }
    keep_largest(core, region);
    FaceQueue queue;
    grow_on(
        work_, faces_, core, queue,
        [&](Index f, Index r) {
          const int motions = std::clamp(kind_[r], 1, 3);
          return slip[r].error_at(faces_.centroid[f], faces_.normal[f], motions) / motions;
        },
        [](Index, Index) { return true; });
    for (Index f = 0; f < core.size(); ++f)
      if (core[f] == kNone) core[f] = region[f];
    return connected_pieces(faces_, core);
  }

  // Of what is left of a patch the largest piece stays; patches that would vanish stay whole.
  void keep_largest(std::vector<Index>& core, const std::vector<Index>& region) const {
    const PatchLabels pieces = connected_pieces(faces_, core);
    std::vector<Index> size(pieces.count, 0), best(sum_.size(), kNone);
    for (const Index p : pieces.patch_of_face) ++size[p];
    for (Index f = 0; f < core.size(); ++f) {
      if (core[f] == kNone) continue;
      Index& b = best[core[f]];
      if (b == kNone || size[pieces.patch_of_face[f]] > size[b]) b = pieces.patch_of_face[f];
    }
    for (Index f = 0; f < core.size(); ++f) {
      if (best[region[f]] == kNone)
        core[f] = region[f];
      else if (core[f] != kNone && best[core[f]] != pieces.patch_of_face[f])
        core[f] = kNone;
    }
  }

  const Work& work_;
  const FaceGraph& faces_;
  const SlippageOptions& options_;
  BallGraph balls_;
  std::vector<SlippageSums> sums_;  // per ball
  std::vector<int> dimension_;      // per ball, of its neighbourhood
  std::vector<Real> certainty_;
  std::vector<Index> patch_;       // per ball
  std::vector<SlippageSums> sum_;  // per patch
  std::vector<int> kind_;
  std::vector<Index> into_;
};

}  // namespace

PatchLabels segment_by_slippage(const Work& work, const FaceGraph& graph, const SlippageOptions& options) {
  return Segments(work, graph, options).run();
}

}  // namespace intarsia::kernels
