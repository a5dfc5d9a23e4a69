#include "kernels/baselines/part_segmentation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {
namespace {

constexpr Real kPi = std::numbers::pi;

// Price of a border across each corner's edge, in mean edges: low in sharp concave creases.
std::vector<Real> border_prices(const Work& work, const MeshView& mesh, const FaceGraph& graph,
                                const PartOptions& options) {
  std::vector<Real> price(graph.neighbour.size(), 0);
  Real total = 0;
  for (Index e = 0; e < mesh.edge_count(); ++e)
    total += (mesh.point(mesh.edge_v1[e]) - mesh.point(mesh.edge_v0[e])).norm();
  const Real mean = mesh.edge_count() > 0 ? total / mesh.edge_count() : 1;
  for_each(work, Cost::light, price.size(), [&](std::size_t c) {
    const Index f = static_cast<Index>(c / 3), o = graph.neighbour[c], e = mesh.face_edge[c];
    if (o == kNone || !(mean > 0)) return;
    const Real length = (mesh.point(mesh.edge_v1[e]) - mesh.point(mesh.edge_v0[e])).norm() / mean;
    Real turn = std::acos(std::clamp(graph.normal[f].dot(graph.normal[o]), Real{-1}, Real{1}));
    if ((graph.centroid[o] - graph.centroid[f]).dot(graph.normal[f]) <= 0) turn *= options.convex;
    price[c] = length * std::min(Real{3}, -std::log(std::clamp(turn / kPi, 1e-3, 1.0))) / 3;
  });
  return price;
}

// Energy of a labelling: what faces cost in their cluster, and borders.
struct Potts {
  const FaceGraph& graph;
  std::vector<Real> price;              // per corner
  std::vector<std::vector<Real>> face;  // per cluster, per face
};

// Each face takes the cheapest label given its neighbours, over and over (iterated conditional modes, Besag 1986).
void relax(const Work& work, const Potts& potts, std::vector<Index>& label) {
  constexpr int kSweeps = 20;
  const Index clusters = static_cast<Index>(potts.face.size());
  std::vector<Real> cost(clusters);
  for (int sweep = 0, changed = 1; sweep < kSweeps && changed > 0; ++sweep) {
    changed = 0;
    for (Index f = 0; f < potts.graph.faces(); ++f) {
      if (f % 4096 == 0) work.check();
      for (Index l = 0; l < clusters; ++l) cost[l] = potts.face[l][f];
      for (int k = 0; k < 3; ++k) {
        const Index o = potts.graph.neighbour[3 * f + k];
        if (o == kNone) continue;
        for (Index l = 0; l < clusters; ++l)
          if (label[o] != l) cost[l] += potts.price[3 * f + k];
      }
      const Index best = static_cast<Index>(std::min_element(cost.begin(), cost.end()) - cost.begin());
      if (cost[best] < cost[label[f]]) label[f] = best, ++changed;
    }
  }
}

// Whole pieces take the label of a neighbour while that lowers the energy; small ones, and the smallest of too many, in
// any case.
PatchLabels merge_pieces(const Work& work, const Potts& potts, const std::vector<Index>& label,
                         const PartOptions& options) {
  const FaceGraph& g = potts.graph;
  PatchLabels pieces = connected_pieces(g, label);
  const Index count = pieces.count, clusters = static_cast<Index>(potts.face.size());
  std::vector<std::vector<Real>> cost(clusters, std::vector<Real>(count, 0));
  std::vector<Real> area(count, 0);
  std::vector<Index> of(count);
  for (Index f = 0; f < g.faces(); ++f) {
    const Index p = pieces.patch_of_face[f];
    area[p] += g.area[f], of[p] = label[f];
    for (Index l = 0; l < clusters; ++l) cost[l][p] += potts.face[l][f];
  }
  const Real total = std::accumulate(area.begin(), area.end(), Real{0});
  std::vector<std::vector<std::pair<Index, Real>>> border(count);  // neighbour, price of the common border
  {
    std::vector<std::tuple<Index, Index, Real>> all;
    for (std::size_t c = 0; c < g.neighbour.size(); ++c) {
      const Index o = g.neighbour[c];
      if (o == kNone) continue;
      const Index p = pieces.patch_of_face[c / 3], q = pieces.patch_of_face[o];
      if (p != q) all.emplace_back(p, q, potts.price[c]);
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
      return std::tie(std::get<0>(a), std::get<1>(a)) < std::tie(std::get<0>(b), std::get<1>(b));
    });
    for (const auto& [p, q, w] : all) {
      if (border[p].empty() || border[p].back().first != q) border[p].emplace_back(q, 0);
      border[p].back().second += w;
    }
  }
  std::vector<Index> into(count);
  std::iota(into.begin(), into.end(), Index{0});
  const auto root = [&](Index p) {
    while (into[p] != p) p = into[p];
    return p;
  };
  for (Index left = count;; --left) {
    work.check();
    Index from = kNone, to = kNone;
    Real best = std::numeric_limits<Real>::infinity();
    for (Index p = 0; p < count; ++p) {
      if (into[p] != p) continue;
      const Real must = area[p] < options.least_area * total ? 1e6 * (1 + total / std::max(area[p], 1e-300)) : 0;
      const Real crowded = left > options.most ? 1e3 * total / std::max(area[p], 1e-300) : 0;
      for (const auto& [q, w] : border[p]) {
        const Real change = cost[of[q]][p] - cost[of[p]][p] - w - std::min(must + crowded, 1e200);
        if (change < best) best = change, from = p, to = q;
      }
    }
    if (from == kNone || best >= 0) break;
    into[from] = to;
    area[to] += area[from];
    for (Index l = 0; l < clusters; ++l) cost[l][to] += cost[l][from];
    for (const Index p : {from, to}) {  // neighbours of both, by their present names
      for (auto& [q, w] : border[p]) q = root(q);
    }
    auto& mine = border[to];
    mine.insert(mine.end(), border[from].begin(), border[from].end());
    border[from].clear();
    const auto tidy = [](std::vector<std::pair<Index, Real>>& row, Index self) {
      std::stable_sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      std::vector<std::pair<Index, Real>> merged;
      for (const auto& [q, w] : row) {
        if (q == self) continue;
        if (merged.empty() || merged.back().first != q) merged.emplace_back(q, 0);
        merged.back().second += w;
      }
      row.swap(merged);
    };
    tidy(mine, to);
    for (const auto& [q, w] : mine) {
      for (auto& [r, x] : border[q]) r = root(r);
      tidy(border[q], q);
    }
  }
  for (Index& p : pieces.patch_of_face) p = root(p);
  return connected_pieces(g, pieces.patch_of_face);
}

}  // namespace

Real Mixture::density(int cluster, Real x) const {
  const std::size_t c = static_cast<std::size_t>(cluster);
  const Real d = (x - mean[c]) / deviation[c];
  return share[c] / (deviation[c] * std::sqrt(2 * kPi)) * std::exp(-d * d / 2);
}

Mixture fit_mixture(std::span<const Real> value, std::span<const Real> weight, int clusters) {
  constexpr int kRounds = 60;
  constexpr Real kLeastShare = 1e-6, kLeastDeviation = 0.02;  // of the range
  const std::size_t k = static_cast<std::size_t>(clusters);
  std::vector<std::size_t> order(value.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::tie(value[a], a) < std::tie(value[b], b); });
  const Real range = value.empty() ? 0 : value[order.back()] - value[order.front()];
  const Real total = std::accumulate(weight.begin(), weight.end(), Real{0});
  Mixture m;
  m.mean.assign(k, value.empty() ? 0 : value[order.front()]);
  m.deviation.assign(k, std::max(range / static_cast<Real>(2 * k), 1e-9));
  m.share.assign(k, 1.0 / static_cast<Real>(k));
  if (!(range > 0) || !(total > 0)) return m;
  Real passed = 0;
  std::size_t c = 0;
  for (const std::size_t i : order) {
    passed += weight[i];
    while (c < k && passed >= total * (static_cast<Real>(c) + 0.5) / static_cast<Real>(k)) m.mean[c++] = value[i];
  }
  std::vector<Real> share(k), first(k), second(k), at(k);
  for (int round = 0; round < kRounds; ++round) {
    std::fill(share.begin(), share.end(), 0), std::fill(first.begin(), first.end(), 0);
    std::fill(second.begin(), second.end(), 0);
    for (std::size_t i = 0; i < value.size(); ++i) {
      Real sum = 0;
      for (std::size_t l = 0; l < k; ++l) sum += at[l] = m.density(static_cast<int>(l), value[i]);
      if (!(sum > 0)) continue;
      for (std::size_t l = 0; l < k; ++l) {
        const Real r = weight[i] * at[l] / sum;
        share[l] += r, first[l] += r * value[i], second[l] += r * value[i] * value[i];
      }
    }
    for (std::size_t l = 0; l < k; ++l) {
      if (!(share[l] > kLeastShare * total)) continue;
      m.share[l] = share[l] / total, m.mean[l] = first[l] / share[l];
      const Real variance = second[l] / share[l] - m.mean[l] * m.mean[l];
      m.deviation[l] = std::max(std::sqrt(std::max(variance, Real{0})), kLeastDeviation * range);
    }
  }
  return m;
}

PatchLabels segment_parts(const Work& work, const MeshView& mesh, const FaceGraph& graph,
                          std::span<const Real> diameter, const PartOptions& options) {
  const auto [low, high] = std::minmax_element(diameter.begin(), diameter.end());
  const Index n = graph.faces();
  if (n == 0 || !(*high > *low)) return connected_pieces(graph);
  std::vector<Real> value(n);
  for (Index f = 0; f < n; ++f)
    value[f] =
        std::log(options.log_factor * (diameter[f] - *low) / (*high - *low) + 1) / std::log(options.log_factor + 1);
  const Mixture mixture = fit_mixture(value, graph.area, options.clusters);
  Potts potts{graph, border_prices(work, mesh, graph, options), {}};
  for (Real& p : potts.price) p *= options.border;
  std::vector<Index> label(n, 0);
  for (int l = 0; l < options.clusters; ++l) {
    std::vector<Real> cost(n);
    for (Index f = 0; f < n; ++f) cost[f] = -std::log(std::max(mixture.density(l, value[f]), 1e-6));
    potts.face.push_back(std::move(cost));
  }
  for (Index f = 0; f < n; ++f)
    for (Index l = 1; l < potts.face.size(); ++l)
      if (potts.face[l][f] < potts.face[label[f]][f]) label[f] = l;
  relax(work, potts, label);
  return merge_pieces(work, potts, label, options);
}

}  // namespace intarsia::kernels
