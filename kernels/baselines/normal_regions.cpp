#include "kernels/baselines/normal_regions.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include <Eigen/Eigenvalues>

namespace intarsia::kernels {
namespace {

constexpr Real kFlat = 1e-9;  // deviations below this are rounding

Vec3 unit_or_zero(const Vec3& v) {
  const Real length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3::Zero();
}

Real deviation(const Vec3& n, const Vec3& proxy) { return std::max(Real{0}, 2 - 2 * n.dot(proxy)); }

// The face of each region that fits best; flat regions have many, of these the one nearest to the middle.
std::vector<Index> best_faces(const FaceGraph& g, std::span<const Index> region, std::span<const Vec3> proxy) {
  const std::size_t count = proxy.size();
  std::vector<Vec3> middle(count, Vec3::Zero());
  std::vector<Real> area(count, 0);
  for (Index f = 0; f < g.faces(); ++f)
    if (region[f] != kNone) middle[region[f]] += g.area[f] * g.centroid[f], area[region[f]] += g.area[f];
  for (std::size_t r = 0; r < count; ++r)
    if (area[r] > 0) middle[r] /= area[r];
  struct Best {
    Real deviation = std::numeric_limits<Real>::infinity(), distance = 0;
    Index face = kNone;
  };
  std::vector<Best> best(count);
  for (Index f = 0; f < g.faces(); ++f) {
    if (region[f] == kNone) continue;
    Best& b = best[region[f]];
    const Real d = std::max(kFlat, deviation(g.normal[f], proxy[region[f]]));
    if (d > b.deviation) continue;
    const Real away = (g.centroid[f] - middle[region[f]]).squaredNorm();
    if (d < b.deviation || away < b.distance) b = {d, away, f};
  }
  std::vector<Index> face(count);
  for (std::size_t r = 0; r < count; ++r) face[r] = best[r].face;
  return face;
}

// Per region: the direction along which its normals vary most; in flat regions, along which it extends most.
struct Axis {
  Vec3 direction, mean;
  bool of_positions;
};
std::vector<Axis> main_axes(const FaceGraph& g, const NormalRegions& regions) {
  const Index count = regions.count();
  std::vector<Eigen::Matrix3d> normals(count, Eigen::Matrix3d::Zero()), places(count, Eigen::Matrix3d::Zero());
  std::vector<Vec3> middle(count, Vec3::Zero());
  for (Index f = 0; f < g.faces(); ++f) middle[regions.region[f]] += g.area[f] * g.centroid[f];
  for (Index r = 0; r < count; ++r)
    if (regions.area[r] > 0) middle[r] /= regions.area[r];
  for (Index f = 0; f < g.faces(); ++f) {
    const Index r = regions.region[f];
    const Vec3 d = g.centroid[f] - middle[r];
    normals[r] += g.area[f] * g.normal[f] * g.normal[f].transpose();
    places[r] += g.area[f] * d * d.transpose();
  }
  std::vector<Axis> axes(count);
  for (Index r = 0; r < count; ++r) {
    const Real a = regions.area[r];
    axes[r].of_positions = !(regions.energy(r) > kFlat * a);
    if (axes[r].of_positions)
      axes[r].mean = middle[r];
    else
      axes[r].mean = regions.sum[r] / a, normals[r] -= a * axes[r].mean * axes[r].mean.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(axes[r].of_positions ? places[r] : normals[r]);
    axes[r].direction = solver.eigenvectors().col(2);
  }
  return axes;
}

// What the energy would grow by.
Real merge_loss(const NormalRegions& regions, Index a, Index b) {
  return 2 * (regions.sum[a].norm() + regions.sum[b].norm() - (regions.sum[a] + regions.sum[b]).norm());
}

// Ids without gaps, in the old order.
void close_gaps(const FaceGraph& g, NormalRegions& regions, std::vector<Index>& id_of, Index count) {
  std::vector<Index> fresh(count, kNone);
  Index used = 0;
  for (Index r = 0; r < count; ++r)
    if (id_of[r] == r) fresh[r] = used++;
  for (Index r = 0; r < count; ++r)
    while (id_of[r] != id_of[id_of[r]]) id_of[r] = id_of[id_of[r]];
  for (Index& r : regions.region) r = fresh[id_of[r]];
  refit(g, regions, used);
}

}  // namespace

Real NormalRegions::total() const {
  Real sum_of_all = 0;
  for (Index r = 0; r < count(); ++r) sum_of_all += energy(r);
  return sum_of_all;
}

Real normal_energy(const FaceGraph& graph, std::span<const Index> region, Index count) {
  NormalRegions r;
  r.region.assign(region.begin(), region.end());
  refit(graph, r, count);
  return r.total();
}

void refit(const FaceGraph& g, NormalRegions& regions, Index count) {
  regions.area.assign(count, 0), regions.sum.assign(count, Vec3::Zero());
  for (Index f = 0; f < g.faces(); ++f) {
    const Index r = regions.region[f];
    regions.area[r] += g.area[f];
    regions.sum[r] += g.area[f] * g.normal[f];
  }
}

void regrow(const Work& work, const FaceGraph& g, NormalRegions& regions, FaceQueue& queue, bool area_in_key) {
  const Index count = regions.count();
  std::vector<Vec3> proxy(count);
  for (Index r = 0; r < count; ++r) proxy[r] = unit_or_zero(regions.sum[r]);
  const std::vector<Index> seed = best_faces(g, regions.region, proxy);
  const auto always = [](Index, Index) { return true; };
  if (area_in_key)
    grow_from(
        work, g, seed, regions.region, queue,
        [&](Index f, Index r) { return g.area[f] * deviation(g.normal[f], proxy[r]); }, always);
  else
    grow_from(
        work, g, seed, regions.region, queue, [&](Index f, Index r) { return deviation(g.normal[f], proxy[r]); },
        always);
  refit(g, regions, count);
}

void regrow_borders(const Work& work, const FaceGraph& g, NormalRegions& regions, FaceQueue& queue, int rings) {
  const Index count = regions.count(), n = g.faces();
  std::vector<Index>& region = regions.region;
  std::vector<std::uint8_t> loose(n, 0);
  std::vector<Index> band, next;
  for (Index f = 0; f < n; ++f)
    for (const Index o : g.around(f))
      if (o != kNone && region[o] != region[f] && !loose[f]) loose[f] = 1, band.push_back(f);
  for (int ring = 1; ring < rings; ++ring, band.swap(next), next.clear())
    for (const Index f : band)
      for (const Index o : g.around(f))
        if (o != kNone && !loose[o]) loose[o] = 1, next.push_back(o);
  // Of what is left of a region its largest piece stays; where nothing is left, the best-fitting face.
  std::vector<Index> kept(n);
  for (Index f = 0; f < n; ++f) kept[f] = loose[f] ? kNone : region[f];
  const PatchLabels pieces = connected_pieces(g, kept);
  std::vector<Index> size(pieces.count, 0), largest(count, kNone);
  for (const Index p : pieces.patch_of_face) ++size[p];
  for (Index f = 0; f < n; ++f) {
    if (kept[f] == kNone) continue;
    Index& best = largest[kept[f]];
    const Index p = pieces.patch_of_face[f];
    if (best == kNone || size[p] > size[best]) best = p;
  }
  std::vector<Vec3> proxy(count);
  for (Index r = 0; r < count; ++r) proxy[r] = unit_or_zero(regions.sum[r]);
  const std::vector<Index> seed = best_faces(g, region, proxy);
  for (Index f = 0; f < n; ++f)
    region[f] = kept[f] != kNone && largest[kept[f]] == pieces.patch_of_face[f] ? kept[f] : kNone;
  for (Index r = 0; r < count; ++r)
    if (largest[r] == kNone) region[seed[r]] = r;
  grow_on(
      work, g, region, queue, [&](Index f, Index r) { return deviation(g.normal[f], proxy[r]); },
      [](Index, Index) { return true; });
  refit(g, regions, count);
}

Halves cut_in_two(const Work& work, const FaceGraph& g, const NormalRegions& regions, FaceQueue& queue) {
  const Index count = regions.count(), n = g.faces();
  const std::vector<Axis> axes = main_axes(g, regions);
  std::vector<Index> half(n);  // 2 r + side
  for (Index f = 0; f < n; ++f) {
    const Axis& a = axes[regions.region[f]];
    const Vec3 d = (a.of_positions ? g.centroid[f] : g.normal[f]) - a.mean;
    half[f] = 2 * regions.region[f] + (a.direction.dot(d) > 0 ? 1 : 0);
  }
  NormalRegions parts;
  const auto inside = [&](Index f, Index h) { return regions.region[f] == h / 2; };
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    parts.region = half;
    refit(g, parts, 2 * count);
    std::vector<Vec3> proxy(2 * std::size_t{count});
    for (Index h = 0; h < 2 * count; ++h) proxy[h] = unit_or_zero(parts.sum[h]);
    const std::vector<Index> seed = best_faces(g, half, proxy);
    grow_from(
        work, g, seed, half, queue, [&](Index f, Index h) { return deviation(g.normal[f], proxy[h]); }, inside);
  }
  parts.region = half;
  refit(g, parts, 2 * count);
  Halves cut;
  cut.side.resize(n);
  for (Index f = 0; f < n; ++f) cut.side[f] = half[f] % 2;
  std::vector<Index> faces(2 * std::size_t{count}, 0);
  for (Index f = 0; f < n; ++f) ++faces[half[f]];
  cut.gain.resize(count);
  for (Index r = 0; r < count; ++r)
    cut.gain[r] = faces[2 * r] == 0 || faces[2 * r + 1] == 0
                      ? -1
                      : std::max(Real{0}, regions.energy(r) - parts.energy(2 * r) - parts.energy(2 * r + 1));
  return cut;
}

void split_best(const Work& work, const FaceGraph& g, NormalRegions& regions, Index count, FaceQueue& queue) {
  const Index old = regions.count();
  const Halves cut = cut_in_two(work, g, regions, queue);
  std::vector<Index> order(old);
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::tuple(-cut.gain[a], -regions.area[a], a) < std::tuple(-cut.gain[b], -regions.area[b], b);
  });
  std::vector<Index> other(old, kNone);
  Index now = old;
  for (const Index r : order)
    if (now < count && cut.gain[r] >= 0) other[r] = now++;
  for (Index f = 0; f < g.faces(); ++f) {
    Index& r = regions.region[f];
    if (other[r] != kNone && cut.side[f]) r = other[r];
  }
  refit(g, regions, now);
}

void merge_cheapest(const Work& work, const FaceGraph& g, NormalRegions& regions, Index count) {
  const Index old = regions.count();
  std::vector<Merge> pairs = merges_by_loss(g, regions);
  std::vector<Index> id_of(old);
  std::iota(id_of.begin(), id_of.end(), Index{0});
  for (Index left = old; left > count && !pairs.empty(); --left) {
    work.check();
    const Merge best = *std::min_element(pairs.begin(), pairs.end());
    id_of[best.b] = best.a;
    regions.sum[best.a] += regions.sum[best.b];
    for (Merge& p : pairs) {
      if (p.a != best.a && p.b != best.a && p.a != best.b && p.b != best.b) continue;
      if (p.a == best.b) p.a = best.a;
      if (p.b == best.b) p.b = best.a;
      if (p.a > p.b) std::swap(p.a, p.b);
      if (p.a != p.b) p.loss = merge_loss(regions, p.a, p.b);
    }
    std::sort(pairs.begin(), pairs.end(),
              [](const Merge& x, const Merge& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
    pairs.erase(std::unique(pairs.begin(), pairs.end(),
                            [](const Merge& x, const Merge& y) { return x.a == y.a && x.b == y.b; }),
                pairs.end());
    std::erase_if(pairs, [](const Merge& p) { return p.a == p.b; });
  }
  close_gaps(g, regions, id_of, old);
}

std::vector<Merge> merges_by_loss(const FaceGraph& g, const NormalRegions& regions) {
  std::vector<Merge> merges;
  for (const auto& [a, b] : adjacent_regions(g, regions.region)) merges.push_back({merge_loss(regions, a, b), a, b});
  std::sort(merges.begin(), merges.end());
  return merges;
}

std::vector<Index> order_by_gain(std::span<const Real> gain) {
  std::vector<Index> order(gain.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return std::tuple(-gain[a], a) < std::tuple(-gain[b], b); });
  return order;
}

void move_regions(const FaceGraph& g, NormalRegions& regions, std::span<const Merge> merge, std::span<const Index> cut,
                  std::span<const std::uint8_t> side) {
  const Index count = regions.count();
  std::vector<Index> into(count, kNone), other(count, kNone);
  for (std::size_t i = 0; i < merge.size(); ++i) into[merge[i].b] = merge[i].a, other[cut[i]] = merge[i].b;
  for (Index f = 0; f < g.faces(); ++f) {
    Index& r = regions.region[f];
    if (into[r] != kNone)
      r = into[r];
    else if (other[r] != kNone && side[f])
      r = other[r];
  }
  refit(g, regions, count);
}

Index teleport(const Work& work, const FaceGraph& g, NormalRegions& regions, FaceQueue& queue) {
  const Halves cut = cut_in_two(work, g, regions, queue);
  const std::vector<Index> by_gain = order_by_gain(cut.gain);
  std::vector<std::uint8_t> used(regions.count(), 0);
  std::vector<Merge> merges;
  std::vector<Index> cuts;
  for (const Merge& m : merges_by_loss(g, regions)) {
    if (used[m.a] || used[m.b]) continue;
    const auto target =
        std::find_if(by_gain.begin(), by_gain.end(), [&](Index r) { return !used[r] && r != m.a && r != m.b; });
    if (target == by_gain.end() || !(cut.gain[*target] > m.loss * (1 + 1e-6) + 1e-12)) break;
    used[m.a] = used[m.b] = used[*target] = 1;
    merges.push_back(m), cuts.push_back(*target);
  }
  if (!merges.empty()) move_regions(g, regions, merges, cuts, cut.side);
  return static_cast<Index>(merges.size());
}

}  // namespace intarsia::kernels
