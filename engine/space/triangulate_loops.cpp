#include "engine/space/triangulate_loops.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace intarsia {
namespace {

constexpr int kRounds = 8;  // of forbidding doubled chords

struct Bridge {
  Real length2 = 0;
  Index from = 0, to = 0;  // positions in the concatenated loops; from on the first loop
};

struct Loops {
  std::span<const Vec3> point;
  std::span<const Index> offset, id;

  Index count() const { return static_cast<Index>(offset.size() - 1); }
  Index id_of(Index position) const { return id.empty() ? position : id[position]; }
  Index next(Index loop, Index position) const {
    return position + 1 == offset[loop + 1] ? offset[loop] : position + 1;
  }
  // An edge of some loop between copies of these two points.
  bool has_edge(Index a, Index b) const {
    for (Index l = 0; l < count(); ++l)
      for (Index p = offset[l]; p < offset[l + 1]; ++p) {
        const Index u = id_of(p), v = id_of(next(l, p));
        if ((u == a && v == b) || (u == b && v == a)) return true;
      }
    return false;
  }
};

Index longest_loop(const Loops& loops) {
  Index longest = 0;
  Real most = -1;
  for (Index l = 0; l < loops.count(); ++l) {
    Real length = 0;
    for (Index p = loops.offset[l]; p < loops.offset[l + 1]; ++p)
      length += (loops.point[loops.next(l, p)] - loops.point[p]).norm();
    if (length > most) most = length, longest = l;
  }
  return longest;
}

// The shortest bridges between two loops; each end serves once, so that they are not all alike.
std::vector<Bridge> shortest_bridges(const Loops& loops, Index base, Index other, int wanted) {
  std::vector<Bridge> all, chosen;
  all.reserve(std::size_t{loops.offset[base + 1] - loops.offset[base]} *
              (loops.offset[other + 1] - loops.offset[other]));
  for (Index p = loops.offset[base]; p < loops.offset[base + 1]; ++p)
    for (Index q = loops.offset[other]; q < loops.offset[other + 1]; ++q)
      all.push_back({(loops.point[p] - loops.point[q]).squaredNorm(), p, q});
  const auto later = [](const Bridge& a, const Bridge& b) {
    return std::tuple(a.length2, a.from, a.to) > std::tuple(b.length2, b.from, b.to);
  };
  std::make_heap(all.begin(), all.end(), later);
  while (!all.empty() && static_cast<int>(chosen.size()) < wanted) {
    std::pop_heap(all.begin(), all.end(), later);
    const Bridge b = all.back();
    all.pop_back();
    const bool used =
        std::any_of(chosen.begin(), chosen.end(), [&](const Bridge& c) { return c.from == b.from || c.to == b.to; });
    if (used || loops.id_of(b.from) == loops.id_of(b.to) || loops.has_edge(loops.id_of(b.from), loops.id_of(b.to)))
      continue;
    chosen.push_back(b);
  }
  return chosen;
}

// The loops joined into one: positions in order, the ends of bridges twice.
void join_loops(const Loops& loops, Index base, std::span<const Bridge> bridge, std::span<const Index> loop_of,
                std::vector<Index>& polygon) {
  polygon.clear();
  for (Index p = loops.offset[base]; p < loops.offset[base + 1]; ++p) {
    polygon.push_back(p);
    for (std::size_t b = 0; b < bridge.size(); ++b) {
      if (bridge[b].from != p) continue;
      Index q = bridge[b].to;
      do {
        polygon.push_back(q);
        q = loops.next(loop_of[b], q);
      } while (q != bridge[b].to);
      polygon.push_back(q);
      polygon.push_back(p);
    }
  }
}

LoopsTriangulation of_polygon(PolygonTriangulation&& one) {
  LoopsTriangulation out;
  out.triangle = std::move(one.triangle), out.cost = one.cost, out.ok = one.ok;
  return out;
}

class Bridging {
 public:
  Bridging(const Loops& loops, const LoopsOptions& options, PolygonScratch& scratch)
      : loops_(loops), options_(options), scratch_(scratch), base_(longest_loop(loops)) {}

  LoopsTriangulation run() {
    LoopsTriangulation out;
    out.bridged = true;
    std::vector<std::vector<Bridge>> choice;
    for (Index l = 0; l < loops_.count(); ++l) {
      Vec3 sum = Vec3::Zero();
      for (Index p = loops_.offset[l]; p < loops_.offset[l + 1]; ++p) sum += loops_.point[p];
      middle_.push_back(sum / (loops_.offset[l + 1] - loops_.offset[l]));
      if (l == base_) continue;
      loop_of_.push_back(l);
      choice.push_back(shortest_bridges(loops_, base_, l, std::max(1, options_.bridges)));
      if (choice.back().empty()) return out;
    }
    const std::vector<std::size_t> radix = limited(choice);
    std::size_t combinations = 1;
    for (const std::size_t r : radix) combinations *= r;

    // Which bridges: by the cheap form, which differs little from the exact one.
    PolygonOptions cheap = options_.polygon;
    cheap.exact = false;
    std::size_t best = 0;
    if (combinations > 1) {
      Real least = 0;
      bool any = false;
      for (std::size_t c = 0; c < combinations; ++c) {
        const PolygonTriangulation t = triangulate(choice, radix, c, cheap);
        if (t.ok && (!any || t.cost < least)) any = true, least = t.cost, best = c;
      }
    }
    PolygonTriangulation t = triangulate(choice, radix, best, options_.polygon);
    for (auto& triangle : t.triangle)
      for (Index& corner : triangle) corner = polygon_[corner];
    out = of_polygon(std::move(t));
    out.bridged = true;
    return out;
  }

 private:
  // Fewer bridges a loop until there are no more than the allowed combinations.
  std::vector<std::size_t> limited(const std::vector<std::vector<Bridge>>& choice) const {
    const std::size_t most = static_cast<std::size_t>(std::max(1, options_.combinations));
    std::vector<std::size_t> radix(choice.size());
    for (std::size_t each = static_cast<std::size_t>(std::max(1, options_.bridges)); each >= 1; --each) {
      std::size_t product = 1;
      for (std::size_t l = 0; l < choice.size(); ++l) {
        radix[l] = std::min(each, choice[l].size());
        product = std::min(product * radix[l], most + 1);
      }
      if (product <= most) break;
    }
    return radix;
  }

  PolygonTriangulation triangulate(const std::vector<std::vector<Bridge>>& choice,
                                   const std::vector<std::size_t>& radix, std::size_t combination,
                                   const PolygonOptions& polygon_options) {
    bridge_.clear();
    for (std::size_t l = 0; l < choice.size(); ++l) {
      bridge_.push_back(choice[l][combination % radix[l]]);
      combination /= radix[l];
    }
    join_loops(loops_, base_, bridge_, loop_of_, polygon_);
    point_.clear(), id_.clear(), loop_.clear();
    for (const Index p : polygon_) {
      point_.push_back(loops_.point[p]), id_.push_back(loops_.id_of(p));
      loop_.push_back(static_cast<Index>(std::upper_bound(loops_.offset.begin(), loops_.offset.end(), p) -
                                         loops_.offset.begin() - 1));
    }
    no_chord_.clear();
    PolygonTriangulation t;
    for (int round = 0; round < kRounds; ++round) {
      const BridgedLoops bridged{loop_, middle_, no_chord_};
      t = triangulate_polygon(point_, id_, polygon_options, scratch_, &bridged);
      if (!t.ok || !forbid_doubled(t)) break;
    }
    return t.ok ? t : triangulate_polygon(point_, id_, polygon_options, scratch_);
  }

  // Two chords between copies of the same two points are one edge with four triangles: the one that cuts off more of
  // the polygon is forbidden. False if there are none.
  bool forbid_doubled(const PolygonTriangulation& t) {
    edge_.clear();
    const Index n = static_cast<Index>(id_.size());
    for (const auto& [i, m, k] : t.triangle)
      for (const auto& [a, b] : {std::pair(i, m), std::pair(m, k), std::pair(i, k)})
        edge_.push_back({std::min(id_[a], id_[b]), std::max(id_[a], id_[b]), std::min(b - a, n - (b - a)), a, b});
    std::sort(edge_.begin(), edge_.end());
    edge_.erase(std::unique(edge_.begin(), edge_.end()), edge_.end());
    bool any = false;
    for (std::size_t e = 1; e < edge_.size(); ++e) {
      const auto &last = edge_[e - 1], &edge = edge_[e];
      if (last[0] != edge[0] || last[1] != edge[1] || edge[2] == 1) continue;  // bridges are polygon edges twice
      no_chord_.push_back({edge[3], edge[4]});
      any = true;
    }
    return any;
  }

  const Loops& loops_;
  const LoopsOptions& options_;
  PolygonScratch& scratch_;
  Index base_;
  std::vector<Index> loop_of_, polygon_, id_, loop_;  // loop_of_: per bridge; loop_: per point
  std::vector<Bridge> bridge_;
  std::vector<std::array<Index, 5>> edge_;  // ids, what it cuts off, positions
  std::vector<std::array<Index, 2>> no_chord_;
  std::vector<Vec3> point_, middle_;  // middle_: per loop
};

}  // namespace

LoopsTriangulation triangulate_loops(std::span<const Vec3> point, std::span<const Index> offset,
                                     std::span<const Index> id, const LoopsOptions& options, PolygonScratch& scratch) {
  const Loops loops{point, offset, id};
  if (loops.count() == 1) return of_polygon(triangulate_polygon(point, id, options.polygon, scratch));
  return Bridging(loops, options, scratch).run();
}

}  // namespace intarsia
