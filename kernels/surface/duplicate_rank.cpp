#include "kernels/surface/duplicate_rank.h"

#include <atomic>
#include <tuple>

#include "engine/base/hash.h"
#include "engine/parallel/compact.h"
#include "engine/parallel/reduce.h"
#include "engine/parallel/sort.h"
#include "engine/parallel/union_find.h"

namespace intarsia::kernels {
namespace {

using Colours = std::vector<std::uint64_t>;

std::uint64_t pair_hash(std::uint64_t a, std::uint64_t b) { return mix64(mix64(a) ^ (b * 0x9e3779b97f4a7c15ull)); }

// Each face is seen from the vertex as (next, previous): a reversed copy looks different.
Colours refine(const Work& work, const Colours& old, std::span<const Index> corner) {
  Colours sum(old.size());
  for_each(work, Cost::light, corner.size(), [&](std::size_t c) {
    const std::size_t f = c / 3 * 3, i = c - f;
    const std::uint64_t face = pair_hash(old[corner[f + (i + 1) % 3]], old[corner[f + (i + 2) % 3]]);
    std::atomic_ref<std::uint64_t>(sum[corner[c]]).fetch_add(face, std::memory_order_relaxed);
  });
  for_each(work, Cost::light, sum.size(), [&](std::size_t v) { sum[v] = pair_hash(old[v], sum[v]); });
  return sum;
}

}  // namespace

std::vector<Index> duplicate_rank(const Work& work, const Vec3View& point, std::span<const Index> corner) {
  const std::size_t n = point.size();
  const auto place = [&](Index v) { return std::tuple(point.x[v], point.y[v], point.z[v]); };
  std::vector<Index> by_place(n);
  std::iota(by_place.begin(), by_place.end(), Index{0});
  sort_total(work, by_place.begin(), by_place.end(),
             [&](Index a, Index b) { return std::tuple(place(a), a) < std::tuple(place(b), b); });
  const auto same = [&](std::size_t i) { return i > 0 && i < n && place(by_place[i]) == place(by_place[i - 1]); };
  const std::vector<Index> kept = compact(work, n, [&](std::size_t i) { return same(i) || same(i + 1); });
  std::vector<Index> shared(kept.size());
  for_each(work, Cost::light, kept.size(), [&](std::size_t i) { shared[i] = by_place[kept[i]]; });

  Colours colour(n);
  for_each(work, Cost::light, n, [&](std::size_t v) {
    Hash h;
    h.add(point.x[v]), h.add(point.y[v]), h.add(point.z[v]);
    colour[v] = h.value();
  });
  const auto sort_and_count = [&] {
    sort_total(work, shared.begin(), shared.end(), [&](Index a, Index b) {
      return std::tuple(place(a), colour[a], a) < std::tuple(place(b), colour[b], b);
    });
    return sum(work, Cost::light, shared.size(), std::size_t{0}, [&](std::size_t i) -> std::size_t {
      return i == 0 || place(shared[i]) != place(shared[i - 1]) || colour[shared[i]] != colour[shared[i - 1]];
    });
  };
  constexpr int kRounds = 64;
  std::size_t classes = sort_and_count();
  for (int round = 0; round < kRounds && classes < shared.size(); ++round) {
    colour = refine(work, colour, corner);
    const std::size_t now = sort_and_count();
    if (now == classes) break;
    classes = now;
  }

  UnionFind component(n);
  if (classes < shared.size())
    for_each(work, Cost::light, corner.size(), [&](std::size_t c) { component.unite(corner[c], corner[c / 3 * 3]); });
  sort_total(work, shared.begin(), shared.end(), [&](Index a, Index b) {
    return std::tuple(place(a), colour[a], component.find(a), a) <
           std::tuple(place(b), colour[b], component.find(b), b);
  });
  std::vector<Index> rank(n, 0);
  for_each(work, Cost::light, shared.size(), [&](std::size_t i) { rank[shared[i]] = static_cast<Index>(i); });
  return rank;
}

}  // namespace intarsia::kernels
