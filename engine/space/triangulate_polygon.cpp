#include "engine/space/triangulate_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/space/polygon_fan.h"

namespace intarsia {
namespace {

using namespace polygon;

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
constexpr Real kPi = std::numbers::pi;
constexpr Real kLid2 = 0.5;         // squared cosine of 45 degrees
constexpr Index kMostExact = 256;   // points
constexpr Real kLeastArea = 1e-14;  // of the squared perimeter: thinner triangles have no normal

Real angle_between(const Facing& a, const Facing& b) {
  if (a.flag == 0 || b.flag == 0) return 0;
  const Vec3 u(a.x, a.y, a.z), v(b.x, b.y, b.z);
  return 2 * std::atan2((u - v).norm(), (u + v).norm());  // Kahan: exact to the last digits near 0 and pi
}

// The metrics. weight: of the chord that the bend is across, 0 on the polygon's own edges.
// limit: candidates behind a chord that cost more are never chosen, whatever triangle is in front of it.
// floor: no more than join(cost, bend), from a lower bound of the squared bend.
struct AreaBend {
  static constexpr bool kInFan = true;  // open_fan() knows this metric
  static Real triangle(Real area) { return area; }
  static Real join(Real a, Real b) { return a + b; }
  static Real bend(Real weight, const Facing& a, const Facing& b) {
    return std::max(Real(0), weight * (a.flag * b.flag - a.dot(b)));
  }
  static Real limit(Real best, Real weight, const Facing& a, const Facing& b) {
    if (a.flag == 0 || b.flag == 0) return best + 2 * weight;
    return best + weight * (Vec3(a.x, a.y, a.z) - Vec3(b.x, b.y, b.z)).norm();
  }
  static Real limit(Real best, Real weight) { return best + 2 * weight; }
};

struct SquaredDihedral {
  static constexpr bool kInFan = false;
  static Real triangle(Real area) { return area < kInfinity ? 0 : area; }
  static Real join(Real a, Real b) { return a + b; }
  static Real bend(Real weight, const Facing& a, const Facing& b) {
    const Real angle = weight * angle_between(a, b);
    return angle * angle;
  }
  static Real limit(Real best, Real weight) { return best + weight * kPi * kPi; }
  static Real floor(Real cost, Real bend2) { return cost + bend2; }
  static Real ceiling(Real best) { return best; }
};

struct WorstDihedral {
  static constexpr bool kInFan = false;
  static Real triangle(Real area) { return area < kInfinity ? 0 : area; }
  static Real join(Real a, Real b) { return std::max(a, b); }
  static Real bend(Real weight, const Facing& a, const Facing& b) { return weight * angle_between(a, b); }
  static Real limit(Real best, Real weight) { return std::max(best, weight * kPi); }
  static Real floor(Real cost, Real bend2) { return std::max(cost * cost, bend2); }  // squares of both
  static Real ceiling(Real best) { return best * best; }
};

// State: chord (i, k), i < k, with the apex of the triangle behind it, that is on the side of i + 1 .. k - 1. What is
// known of a chord stands in rows i and k of symmetric matrices, so that every loop over apexes runs along rows.
template <class Metric>
class Dynamic {
 public:
  Dynamic(std::span<const Vec3> point, const PolygonOptions& options, PolygonScratch& scratch,
          const BridgedLoops* bridged)
      : n_(static_cast<Index>(point.size())),
        stride_(whole_lanes(n_)),
        exact_(options.exact && n_ <= kMostExact),
        scratch_(scratch),
        bridged_(bridged) {
    const std::size_t matrix = n_ * stride_;
    scratch.real.resize(7 * matrix + 11 * stride_);
    scratch.apex.resize(matrix);
    Real* next = scratch.real.data();
    const auto take = [&](std::size_t count) {
      Real* taken = next;
      next += count;
      return taken;
    };
    for (Real** m : {&cost_, &weight_, &flag_, &nx_, &ny_, &nz_, &second_}) *m = take(matrix);
    for (Real** v :
         {&x_, &y_, &z_, &fan_.area, &fan_.flag, &fan_.x, &fan_.y, &fan_.z, &fan_.left, &fan_.right, &fan_.sum})
      *v = take(stride_);
    Real perimeter = 0;
    for (Index i = 0; i < n_; ++i) {
      x_[i] = point[i].x(), y_[i] = point[i].y(), z_[i] = point[i].z();
      perimeter += (point[(i + 1) % n_] - point[i]).norm();
    }
    least_area_ = kLeastArea * perimeter * perimeter;
    std::fill(cost_, cost_ + 7 * matrix, Real(0));
    for (Index i = 0; i < n_; ++i)
      for (Index k = i + 2; k < n_; ++k) {
        if (i == 0 && k == n_ - 1) continue;
        const Real weight = Metric::kInFan ? options.bend_weight * (point[k] - point[i]).squaredNorm() : 1;
        weight_[at(i, k)] = weight_[at(k, i)] = weight;
      }
    if (!exact_) return;
    scratch.first.assign(matrix, 0);
    scratch.packs.assign(matrix, 0);
    scratch.pack.clear();
    scratch.pack_apex.clear();
  }

  // forbidden: n x n, or empty.
  bool solve(const std::vector<std::uint8_t>& forbidden) {
    for (Index i = n_ - 2; i-- > 0;)
      for (Index k = i + 2; k < n_; ++k) {
        if (!forbidden.empty() && forbidden[std::size_t{i} * n_ + k])
          close(i, k);
        else if (exact_)
          solve_exact(i, k);
        else
          solve_cheap(i, k);
      }
    return cost_[at(0, n_ - 1)] < kInfinity;
  }

  void collect(PolygonTriangulation& out) {
    out.cost = cost_[at(0, n_ - 1)];
    out.triangle.reserve(n_ - 2);
    auto& stack = scratch_.order;  // triples (i, k, apex)
    stack.clear();
    const auto push = [&](Index i, Index k, Index apex) {
      stack.push_back(i), stack.push_back(k), stack.push_back(apex);
    };
    push(0, n_ - 1, scratch_.apex[at(0, n_ - 1)]);
    while (!stack.empty()) {
      const Index m = stack.back(), k = stack[stack.size() - 2], i = stack[stack.size() - 3];
      stack.resize(stack.size() - 3);
      out.triangle.push_back({i, m, k});
      open(i, k, m, m + 1);
      const Facing front = in_fan(m);
      if (k - m > 1) push(m, k, behind(m, k, front).apex);
      if (m - i > 1) push(i, m, behind(i, m, front).apex);
    }
  }

 private:
  struct Behind {
    Real cost;
    Index apex;
  };

  std::size_t at(Index i, Index k) const { return i * stride_ + k; }
  Row row(Index i) const {
    const std::size_t o = at(i, 0);
    return {cost_ + o, weight_ + o, flag_ + o, nx_ + o, ny_ + o, nz_ + o};
  }
  Facing head(Index i, Index k) const { return {flag_[at(i, k)], nx_[at(i, k)], ny_[at(i, k)], nz_[at(i, k)]}; }
  Facing in_fan(Index m) const { return {fan_.flag[m], fan_.x[m], fan_.y[m], fan_.z[m]}; }

  void open(Index i, Index k, Index from, Index to) {
    const Real ends[6] = {x_[i], y_[i], z_[i], x_[k], y_[k], z_[k]};
    open_fan(x_, y_, z_, ends, least_area_, row(i), row(k), from, to, fan_);
    if (bridged_ && bridged_->loop[i] == bridged_->loop[k])
      for (Index m = from; m < to; ++m)
        if (bridged_->loop[m] == bridged_->loop[i] && is_lid(i, m, k)) fan_.area[m] = fan_.sum[m] = kInfinity;
  }
  bool is_lid(Index i, Index m, Index k) const {
    const Vec3 normal(fan_.x[m], fan_.y[m], fan_.z[m]);
    const Vec3 centre = Vec3(x_[i] + x_[m] + x_[k], y_[i] + y_[m] + y_[k], z_[i] + z_[m] + z_[k]) / 3;
    for (Index l = 0; l < bridged_->middle.size(); ++l) {
      if (l == bridged_->loop[i]) continue;
      const Vec3 to = bridged_->middle[l] - centre;
      const Real along = to.dot(normal);
      if (along * along > kLid2 * to.squaredNorm()) return true;
    }
    return false;
  }

  void close(Index i, Index k) {
    cost_[at(i, k)] = cost_[at(k, i)] = second_[at(i, k)] = second_[at(k, i)] = kInfinity;
  }

  void set_head(Index i, Index k, Real cost, const Facing& facing, Index apex, Real second) {
    for (const std::size_t c : {at(i, k), at(k, i)}) {
      cost_[c] = cost, flag_[c] = facing.flag, nx_[c] = facing.x, ny_[c] = facing.y, nz_[c] = facing.z;
      second_[c] = second, scratch_.apex[c] = apex;
    }
  }

  // The least cost behind chord (i, k) if the triangle in front of it faces so; ties to the smallest apex.
  Behind behind(Index i, Index k, const Facing& front) const {
    const std::size_t c = at(i, k);
    Behind best{Metric::join(cost_[c], Metric::bend(weight_[c], front, head(i, k))), scratch_.apex[c]};
    if (best.cost >= second_[c]) scan(c, front, best);
    return best;
  }
  void scan(std::size_t c, const Facing& front, Behind& best) const {
    const Real f[4] = {front.flag, front.x, front.y, front.z};
    for (Index p = 0; p < scratch_.packs[c]; ++p) {
      const PolygonScratch::Pack& pack = scratch_.pack[scratch_.first[c] + p];
      if (pack.cost[0] > best.cost) return;
      const Index* apex = scratch_.pack_apex.data() + (scratch_.first[c] + p) * kLanes;
      alignas(64) Real least[kLanes] = {};
      if constexpr (!Metric::kInFan) least_angles2(pack, f, least);
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if constexpr (!Metric::kInFan)
          if (Metric::floor(pack.cost[lane], least[lane]) > Metric::ceiling(best.cost)) continue;
        if (pack.cost[lane] > best.cost) continue;
        const Real cost = Metric::join(pack.cost[lane], Metric::bend(weight_[c], front, facing(pack, lane)));
        if (cost < best.cost || (cost == best.cost && apex[lane] < best.apex)) best = {cost, apex[lane]};
      }
    }
  }
  static Facing facing(const PolygonScratch::Pack& p, std::size_t lane) {
    return {p.flag[lane], p.x[lane], p.y[lane], p.z[lane]};
  }

  // Cost behind both sides of triangle (i, m, k); the fan is open.
  Real sides(Index i, Index m, Index k) const {
    if constexpr (Metric::kInFan) {
      const Real front[4] = {fan_.flag[m], fan_.x[m], fan_.y[m], fan_.z[m]};
      const auto least = [&](std::size_t c, Real with_head) {
        if (with_head <= second_[c]) return with_head;
        return least_with_bend(scratch_.pack.data() + scratch_.first[c], scratch_.packs[c], weight_[c], front,
                               with_head);
      };
      const Real left = least(at(i, m), fan_.left[m]);
      return left + least(at(m, k), fan_.right[m]);
    } else {
      const Real left = m - i > 1 ? behind(i, m, in_fan(m)).cost : 0;
      return Metric::join(left, k - m > 1 ? behind(m, k, in_fan(m)).cost : 0);
    }
  }

  void solve_cheap(Index i, Index k) {
    open(i, k, i + 1, k);
    Real best = kInfinity;
    Index apex = kNone;
    if constexpr (Metric::kInFan) {
      if (const Index m = first_least(fan_.sum, i + 1, k); m < k) best = fan_.sum[m], apex = m;
    } else {
      for (Index m = i + 1; m < k; ++m) {
        if (!(Metric::join(cost_[at(i, m)], cost_[at(k, m)]) < best)) continue;
        const Real cost = Metric::triangle(fan_.area[m]) + sides(i, m, k);
        if (cost < best) best = cost, apex = m;
      }
    }
    if (apex == kNone) return close(i, k);
    set_head(i, k, best, in_fan(apex), apex, kInfinity);
  }

  void solve_exact(Index i, Index k) {
    open(i, k, i + 1, k);
    const Real* left = cost_ + at(i, 0);
    const Real* right = cost_ + at(k, 0);
    const Real weight = weight_[at(i, k)];
    // Some apex costs no more than this one.
    Real known = kInfinity;
    Index likely = kNone;
    for (Index m = i + 1; m < k; ++m) {
      const Real cost = Metric::kInFan ? fan_.sum[m] : Metric::triangle(fan_.area[m]) + Metric::join(left[m], right[m]);
      if (cost < known) known = cost, likely = m;
    }
    if (likely == kNone) return close(i, k);
    if constexpr (!Metric::kInFan) known = sides(i, likely, k);
    Real limit = Metric::limit(known, weight);

    // Whether candidates with this cost never matter.
    Candidate best{kInfinity, kNone};
    const auto is_worse = [&](Real cost, Index m) {
      if (!(cost <= limit)) return true;
      if constexpr (Metric::kInFan)
        return best.apex != kNone && cost > Metric::limit(best.cost, weight, in_fan(best.apex), in_fan(m));
      return false;
    };
    auto& list = scratch_.fresh;
    list.clear();
    for (Index m = i + 1; m < k; ++m) {
      const Real area = Metric::triangle(fan_.area[m]), least = area + Metric::join(left[m], right[m]);
      if (least == kInfinity || is_worse(least, m)) continue;
      const Real cost = area + sides(i, m, k);
      if (!(cost <= limit)) continue;
      list.push_back({cost, m});
      if (cost < best.cost) best = {cost, m}, limit = std::min(limit, Metric::limit(cost, weight));
    }
    std::erase_if(list, [&](const Candidate& c) { return c.apex == best.apex || is_worse(c.cost, c.apex); });
    std::sort(list.begin(), list.end(), [](const Candidate& a, const Candidate& b) {
      return a.cost < b.cost || (a.cost == b.cost && a.apex < b.apex);
    });

    // The best one stands in the matrices, the others in packs.
    const std::size_t c = at(i, k), packs = whole_lanes(list.size()) / kLanes;
    scratch_.first[c] = scratch_.pack.size();
    scratch_.packs[c] = static_cast<Index>(packs);
    scratch_.pack.resize(scratch_.pack.size() + packs);
    scratch_.pack_apex.resize(scratch_.pack.size() * kLanes, kNone);
    for (std::size_t q = 0; q < list.size(); ++q) {
      const Index m = list[q].apex;
      const std::size_t at_pack = scratch_.first[c] + q / kLanes, lane = q % kLanes;
      PolygonScratch::Pack& pack = scratch_.pack[at_pack];
      pack.cost[lane] = list[q].cost, pack.flag[lane] = fan_.flag[m];
      pack.x[lane] = fan_.x[m], pack.y[lane] = fan_.y[m], pack.z[lane] = fan_.z[m];
      scratch_.pack_apex[at_pack * kLanes + lane] = m;
    }
    set_head(i, k, best.cost, in_fan(best.apex), best.apex, list.empty() ? kInfinity : list[0].cost);
  }

  using Candidate = PolygonScratch::Candidate;

  Index n_;
  std::size_t stride_;
  bool exact_;
  PolygonScratch& scratch_;
  const BridgedLoops* bridged_;
  Real least_area_ = 0;
  Real *cost_ = nullptr, *weight_ = nullptr, *flag_ = nullptr, *nx_ = nullptr, *ny_ = nullptr, *nz_ = nullptr;
  Real* second_ = nullptr;  // least cost in the packs
  Real *x_, *y_, *z_;
  Fan fan_;
};

// Chords between copies of one point, and those that would double a polygon edge.
void forbid(std::span<const Index> id, std::vector<std::uint8_t>& forbidden, std::vector<Index>& order) {
  const Index n = static_cast<Index>(id.size());
  forbidden.clear();
  order.resize(n);
  for (Index i = 0; i < n; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return std::pair(id[a], a) < std::pair(id[b], b); });
  const auto copies = [&](Index wanted) {
    const auto less = [&](Index a, Index b) { return id[a] < b; };
    const auto begin = std::lower_bound(order.begin(), order.end(), wanted, less);
    auto end = begin;
    while (end != order.end() && id[*end] == wanted) ++end;
    return std::span<const Index>(begin, end);
  };
  bool any = false;
  for (Index i = 0; i + 1 < n; ++i) any |= id[order[i]] == id[order[i + 1]];
  if (!any) return;
  forbidden.assign(std::size_t{n} * n, 0);
  const auto mark = [&](Index a, Index b) {
    const Index gap = a < b ? b - a : a - b;
    if (gap > 1 && gap != n - 1) forbidden[std::size_t{a} * n + b] = forbidden[std::size_t{b} * n + a] = 1;
  };
  for (Index i = 0; i < n; ++i) {
    const auto same = copies(id[i]), next = copies(id[(i + 1) % n]);
    for (const Index a : same) {
      mark(i, a);
      for (const Index b : next) mark(a, b);
    }
  }
}

template <class Metric>
PolygonTriangulation run(std::span<const Vec3> point, const PolygonOptions& options, PolygonScratch& scratch,
                         const BridgedLoops* bridged) {
  PolygonTriangulation out;
  Dynamic<Metric> dynamic(point, options, scratch, bridged);
  out.ok = dynamic.solve(scratch.forbidden);
  if (out.ok) dynamic.collect(out);
  return out;
}

}  // namespace

PolygonTriangulation triangulate_polygon(std::span<const Vec3> point, std::span<const Index> id,
                                         const PolygonOptions& options, PolygonScratch& scratch,
                                         const BridgedLoops* bridged) {
  if (point.size() < 3) return {};
  forbid(id, scratch.forbidden, scratch.order);
  if (bridged && !bridged->no_chord.empty()) {
    const std::size_t n = point.size();
    scratch.forbidden.resize(n * n, 0);
    for (const auto& [i, k] : bridged->no_chord) scratch.forbidden[i * n + k] = scratch.forbidden[k * n + i] = 1;
  }
  switch (options.metric) {
    case PolygonMetric::area: {
      PolygonOptions plain = options;
      plain.bend_weight = 0, plain.exact = false;  // without bends a chord's best is best for every front
      return run<AreaBend>(point, plain, scratch, bridged);
    }
    case PolygonMetric::area_bend:
      return run<AreaBend>(point, options, scratch, bridged);
    case PolygonMetric::squared_dihedral:
      return run<SquaredDihedral>(point, options, scratch, bridged);
    case PolygonMetric::worst_dihedral:
      return run<WorstDihedral>(point, options, scratch, bridged);
  }
  return {};
}

}  // namespace intarsia
