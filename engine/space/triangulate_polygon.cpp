#include "engine/space/triangulate_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/lanes.h"

namespace intarsia {
namespace {

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
constexpr Real kPi = std::numbers::pi;
constexpr Real kLid2 = 0.5;         // squared cosine of 45 degrees
constexpr Real kLeastArea = 1e-14;  // of the squared perimeter: thinner triangles have no normal

// A normal with its weight: (0, 0, 0, 0) for a triangle without area and for what lies outside the polygon.
struct Facing {
  Real flag = 0, x = 0, y = 0, z = 0;
  Real dot(const Facing& o) const { return x * o.x + y * o.y + z * o.z; }
};

// Two chords' rows, for every apex m: chord (i, m) or (m, k) with what is best behind it.
struct Row {
  const Real *cost, *weight, *flag, *x, *y, *z;
};

// What the triangles (i, m, k) of one chord look like, for every apex m.
struct Fan {
  Real *area, *flag, *x, *y, *z, *left, *right;
};

// left, right: cost behind the chords (i, m), (m, k) if the best triangle behind each is taken, with its bend.
INTARSIA_WIDE void open_fan(const Real* __restrict px, const Real* __restrict py, const Real* __restrict pz,
                            const Real* ends, Real least_area, const Row& l, const Row& r, Index from, Index to,
                            const Fan& out) {
  const Real ax = ends[0], ay = ends[1], az = ends[2], vx = ends[3] - ax, vy = ends[4] - ay, vz = ends[5] - az;
  const Real* __restrict lc = l.cost, * __restrict lw = l.weight, * __restrict lf = l.flag, * __restrict lx = l.x, * __restrict ly = l.y, * __restrict lz = l.z;
  const Real* __restrict rc = r.cost, * __restrict rw = r.weight, * __restrict rf = r.flag, * __restrict rx = r.x, * __restrict ry = r.y, * __restrict rz = r.z;
  Real* __restrict area = out.area, * __restrict flag = out.flag, * __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z, * __restrict left = out.left, * __restrict right = out.right;
  for (Index m = from; m < to; ++m) {
    const Real ux = px[m] - ax, uy = py[m] - ay, uz = pz[m] - az;
    const Real cx = uy * vz - uz * vy, cy = uz * vx - ux * vz, cz = ux * vy - uy * vx;
    const Real length = std::sqrt(cx * cx + cy * cy + cz * cz);
    const bool wide = Real(0.5) * length > least_area;
    const Real f = wide ? Real(1) : Real(0), scale = f / (wide ? length : Real(1));
    const Real nx = cx * scale, ny = cy * scale, nz = cz * scale;
    const Real bl = lw[m] * (f * lf[m] - (nx * lx[m] + ny * ly[m] + nz * lz[m]));
    const Real br = rw[m] * (f * rf[m] - (nx * rx[m] + ny * ry[m] + nz * rz[m]));
    area[m] = Real(0.5) * length, flag[m] = f, x[m] = nx, y[m] = ny, z[m] = nz;
    left[m] = lc[m] + (bl > 0 ? bl : Real(0));
    right[m] = rc[m] + (br > 0 ? br : Real(0));
  }
}

Real angle_between(const Facing& a, const Facing& b) {
  if (a.flag == 0 || b.flag == 0) return 0;
  const Vec3 u(a.x, a.y, a.z), v(b.x, b.y, b.z);
  return 2 * std::atan2((u - v).norm(), (u + v).norm());  // Kahan: exact to the last digits near 0 and pi
}

// The metrics. weight: of the chord that the bend is across, 0 on the polygon's own edges.
// limit: candidates behind a chord that cost more are never chosen, whatever triangle is in front of it.
struct AreaBend {
  static constexpr bool fan_has_bends = true;
  static Real triangle(Real area) { return area; }
  static Real join(Real a, Real b) { return a + b; }
  static Real bend(Real weight, const Facing& a, const Facing& b) {
    return std::max(Real(0), weight * (a.flag * b.flag - a.dot(b)));
  }
  static Real limit(Real best, Real weight) { return best + 2 * weight; }
  static Real limit(Real best, Real weight, const Facing& a, const Facing& b) {
    if (a.flag == 0 || b.flag == 0) return limit(best, weight);
    return best + weight * (Vec3(a.x, a.y, a.z) - Vec3(b.x, b.y, b.z)).norm();
  }
};

struct SquaredDihedral {
  static constexpr bool fan_has_bends = false;
  static Real triangle(Real area) { return area < kInfinity ? 0 : area; }
  static Real join(Real a, Real b) { return a + b; }
  static Real bend(Real weight, const Facing& a, const Facing& b) {
    const Real angle = weight * angle_between(a, b);
    return angle * angle;
  }
  static Real limit(Real best, Real weight) { return best + weight * kPi * kPi; }
  static Real limit(Real best, Real weight, const Facing&, const Facing&) { return limit(best, weight); }
};

struct WorstDihedral {
  static constexpr bool fan_has_bends = false;
  static Real triangle(Real area) { return area < kInfinity ? 0 : area; }
  static Real join(Real a, Real b) { return std::max(a, b); }
  static Real bend(Real weight, const Facing& a, const Facing& b) { return weight * angle_between(a, b); }
  static Real limit(Real best, Real weight) { return std::max(best, weight * kPi); }
  static Real limit(Real best, Real weight, const Facing&, const Facing&) { return limit(best, weight); }
};

// State: chord (i, k), i < k, with the apex of the triangle behind it, that is on the side of i + 1 .. k - 1. What is
// known of a chord stands in rows i and k of symmetric matrices, so that every loop over apexes runs along rows.
template <class Metric>
class Dynamic {
 public:
  Dynamic(std::span<const Vec3> point, const PolygonOptions& options, PolygonScratch& scratch,
          const BridgedLoops* bridged)
      : n_(static_cast<Index>(point.size())), exact_(options.exact), scratch_(scratch), bridged_(bridged) {
    const std::size_t matrix = std::size_t{n_} * n_;
    scratch.real.resize(7 * matrix + 10 * std::size_t{n_});
    scratch.apex.resize(matrix);
    Real* next = scratch.real.data();
    const auto take = [&](std::size_t count) {
      Real* taken = next;
      next += count;
      return taken;
    };
    for (Real** m : {&cost_, &weight_, &flag_, &nx_, &ny_, &nz_, &second_}) *m = take(matrix);
    for (Real** v : {&x_, &y_, &z_, &fan_.area, &fan_.flag, &fan_.x, &fan_.y, &fan_.z, &fan_.left, &fan_.right})
      *v = take(n_);
    Real perimeter = 0;
    for (Index i = 0; i < n_; ++i) {
      x_[i] = point[i].x(), y_[i] = point[i].y(), z_[i] = point[i].z();
      perimeter += (point[(i + 1) % n_] - point[i]).norm();
    }
    least_area_ = kLeastArea * perimeter * perimeter;
    std::fill(cost_, cost_ + 7 * matrix, Real(0));
    for (Index i = 0; i < n_; ++i)
      for (Index k = i + 2; k < n_; ++k) {
        const bool edge = i == 0 && k == n_ - 1;
        const Real weight = edge                    ? 0
                            : Metric::fan_has_bends ? options.bend_weight * (point[k] - point[i]).squaredNorm()
                                                    : 1;
        weight_[at(i, k)] = weight_[at(k, i)] = weight;
      }
    scratch.first.assign(matrix, 0);
    scratch.size.assign(matrix, 0);
    scratch.candidate.clear();
  }

  // forbidden: n x n, or empty.
  bool solve(const std::vector<std::uint8_t>& forbidden) {
    for (Index span = 2; span < n_; ++span)
      for (Index i = 0; i + span < n_; ++i) {
        const Index k = i + span;
        if (!forbidden.empty() && forbidden[at(i, k)])
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
    out.triangle.clear();
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
      const Facing front = facing(i, m, k);
      if (k - m > 1) push(m, k, behind(m, k, front).apex);
      if (m - i > 1) push(i, m, behind(i, m, front).apex);
    }
  }

 private:
  struct Behind {
    Real cost;
    Index apex;
  };

  std::size_t at(Index i, Index k) const { return std::size_t{i} * n_ + k; }
  Row row(Index i) const {
    const std::size_t o = at(i, 0);
    return {cost_ + o, weight_ + o, flag_ + o, nx_ + o, ny_ + o, nz_ + o};
  }
  Facing head(Index i, Index k) const { return {flag_[at(i, k)], nx_[at(i, k)], ny_[at(i, k)], nz_[at(i, k)]}; }
  Facing in_fan(Index m) const { return {fan_.flag[m], fan_.x[m], fan_.y[m], fan_.z[m]}; }
  Facing facing(Index i, Index m, Index k) {
    open(i, k, m, m + 1);
    return in_fan(m);
  }

  void open(Index i, Index k, Index from, Index to) {
    const Real ends[6] = {x_[i], y_[i], z_[i], x_[k], y_[k], z_[k]};
    open_fan(x_, y_, z_, ends, least_area_, row(i), row(k), from, to, fan_);
    if (bridged_ && bridged_->loop[i] == bridged_->loop[k])
      for (Index m = from; m < to; ++m)
        if (bridged_->loop[m] == bridged_->loop[i] && is_lid(i, m, k)) fan_.area[m] = kInfinity;
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

  // The least cost behind chord (i, k) if the triangle in front of it faces so. Candidates are in the order of their
  // cost, and a bend adds at least nothing: the scan ends where the cost alone is no better.
  Behind behind(Index i, Index k, const Facing& front) const {
    const std::size_t c = at(i, k);
    Behind best{Metric::join(cost_[c], Metric::bend(weight_[c], front, head(i, k))), scratch_.apex[c]};
    if (best.cost > second_[c]) scan(c, front, best);
    return best;
  }
  void scan(std::size_t c, const Facing& front, Behind& best) const {
    const PolygonScratch::Candidate* list = scratch_.candidate.data() + scratch_.first[c];
    for (Index q = 0; q < scratch_.size[c] && list[q].cost < best.cost; ++q) {
      const Facing f{list[q].flag, list[q].x, list[q].y, list[q].z};
      const Real cost = Metric::join(list[q].cost, Metric::bend(weight_[c], front, f));
      if (cost < best.cost) best = {cost, list[q].apex};
    }
  }

  // Cost behind both sides of triangle (i, m, k); the fan is open.
  Real sides(Index i, Index m, Index k) const {
    if constexpr (Metric::fan_has_bends) {
      Behind l{fan_.left[m], kNone}, r{fan_.right[m], kNone};
      if (l.cost > second_[at(i, m)]) scan(at(i, m), in_fan(m), l);
      if (r.cost > second_[at(k, m)]) scan(at(m, k), in_fan(m), r);
      return l.cost + r.cost;
    } else {
      const Real l = m - i > 1 ? behind(i, m, in_fan(m)).cost : 0;
      return Metric::join(l, k - m > 1 ? behind(m, k, in_fan(m)).cost : 0);
    }
  }

  void solve_cheap(Index i, Index k) {
    open(i, k, i + 1, k);
    Real best = kInfinity;
    Index apex = kNone;
    for (Index m = i + 1; m < k; ++m) {
      Real cost = fan_.area[m] + (fan_.left[m] + fan_.right[m]);
      if constexpr (!Metric::fan_has_bends)
        cost = Metric::join(cost_[at(i, m)], cost_[at(k, m)]) < best ? Metric::triangle(fan_.area[m]) + sides(i, m, k)
                                                                     : kInfinity;
      if (cost < best) best = cost, apex = m;
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
      const Real cost = Metric::fan_has_bends ? fan_.area[m] + (fan_.left[m] + fan_.right[m])
                                              : Metric::triangle(fan_.area[m]) + Metric::join(left[m], right[m]);
      if (cost < known) known = cost, likely = m;
    }
    if (likely == kNone) return close(i, k);
    if constexpr (!Metric::fan_has_bends) known = sides(i, likely, k);
    Real limit = Metric::limit(known, weight);

    auto& list = scratch_.fresh;
    list.clear();
    std::size_t best = 0;
    for (Index m = i + 1; m < k; ++m) {
      const Real area = Metric::triangle(fan_.area[m]);
      const Real least = area + Metric::join(left[m], right[m]);
      if (!(least <= limit) || least == kInfinity) continue;
      const Real cost = area + sides(i, m, k);
      if (!(cost <= limit)) continue;
      list.push_back({cost, fan_.flag[m], fan_.x[m], fan_.y[m], fan_.z[m], m});
      if (cost < list[best].cost) best = list.size() - 1;
      limit = std::min(limit, Metric::limit(cost, weight));
    }
    const PolygonScratch::Candidate first = list[best];
    const Facing facing{first.flag, first.x, first.y, first.z};
    std::erase_if(list, [&](const PolygonScratch::Candidate& c) {
      return c.cost > Metric::limit(first.cost, weight, facing, {c.flag, c.x, c.y, c.z});
    });
    std::sort(list.begin(), list.end(),
              [](const auto& a, const auto& b) { return a.cost < b.cost || (a.cost == b.cost && a.apex < b.apex); });
    // The first stands in the matrices, the others in the list.
    scratch_.first[at(i, k)] = scratch_.candidate.size();
    scratch_.size[at(i, k)] = static_cast<Index>(list.size() - 1);
    scratch_.candidate.insert(scratch_.candidate.end(), list.begin() + 1, list.end());
    set_head(i, k, first.cost, facing, first.apex, list.size() > 1 ? list[1].cost : kInfinity);
  }

  Index n_;
  bool exact_;
  PolygonScratch& scratch_;
  const BridgedLoops* bridged_;
  Real least_area_ = 0;
  Real *cost_, *weight_, *flag_, *nx_, *ny_, *nz_, *second_;  // second_: cost of the second candidate
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
