#include "engine/space/triangulate_polygon.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <doctest/doctest.h>

#include "engine/base/random.h"

namespace intarsia {
namespace {

using Triangles = std::vector<std::array<Index, 3>>;
constexpr PolygonMetric kMetrics[] = {PolygonMetric::area, PolygonMetric::area_bend, PolygonMetric::squared_dihedral,
                                      PolygonMetric::worst_dihedral};

std::vector<Vec3> random_loop(Index n, std::uint64_t seed) {
  const Random random(seed, 5);
  std::vector<Vec3> loop;
  for (Index i = 0; i < n; ++i) {
    const Real a = 2 * std::numbers::pi * i / n;
    loop.emplace_back(std::cos(a) + .6 * random.uniform(i, 0), std::sin(a) + .6 * random.uniform(i, 1),
                      1.5 * random.uniform(i, 2));
  }
  return loop;
}

std::vector<Vec3> circle(Index n) {
  std::vector<Vec3> loop;
  for (Index i = 0; i < n; ++i) {
    const Real a = 2 * std::numbers::pi * i / n;
    loop.emplace_back(std::cos(a), std::sin(a), 0);
  }
  return loop;
}

const std::vector<Vec3> kPetrie = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}, {0, 0, 1}};

// Cost of a triangulation by the definition, bends by inner edges.
Real cost_of(const std::vector<Vec3>& p, const Triangles& triangles, const PolygonOptions& o) {
  const Index n = static_cast<Index>(p.size());
  std::map<std::pair<Index, Index>, std::vector<Vec3>> edge;
  Real sum = 0, worst = 0;
  for (const auto& t : triangles) {
    const Vec3 normal = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
    if (o.metric == PolygonMetric::area || o.metric == PolygonMetric::area_bend) sum += normal.norm() / 2;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      edge[{std::min(a, b), std::max(a, b)}].push_back(normal.normalized());
    }
  }
  for (const auto& [ends, normal] : edge) {
    const Index gap = ends.second - ends.first;
    if (gap == 1 || gap == n - 1) continue;
    const Real cosine = std::clamp(normal[0].dot(normal[1]), Real(-1), Real(1)), angle = std::acos(cosine);
    if (o.metric == PolygonMetric::area_bend)
      sum += o.bend_weight * (p[ends.first] - p[ends.second]).squaredNorm() * (1 - cosine);
    if (o.metric == PolygonMetric::squared_dihedral) sum += angle * angle;
    worst = std::max(worst, angle);
  }
  return o.metric == PolygonMetric::worst_dihedral ? worst : sum;
}

// Every triangulation of the polygon from..to.
std::vector<Triangles> all_triangulations(Index from, Index to) {
  if (to - from < 2) return {{}};
  std::vector<Triangles> out;
  for (Index m = from + 1; m < to; ++m)
    for (const Triangles& l : all_triangulations(from, m))
      for (const Triangles& r : all_triangulations(m, to)) {
        Triangles t = l;
        t.insert(t.end(), r.begin(), r.end());
        t.push_back({from, m, to});
        out.push_back(t);
      }
  return out;
}

PolygonTriangulation solve(const std::vector<Vec3>& p, PolygonMetric metric, bool exact = true,
                           std::span<const Index> id = {}) {
  PolygonScratch scratch;
  return triangulate_polygon(p, id, {metric, .3, exact}, scratch);
}

void check_topology(const PolygonTriangulation& t, Index n) {
  REQUIRE(t.ok);
  REQUIRE(t.triangle.size() == n - 2);
  std::map<std::pair<Index, Index>, int> half;
  for (const auto& c : t.triangle)
    for (std::size_t i = 0; i < 3; ++i) ++half[{c[i], c[(i + 1) % 3]}];
  Index inner = 0;
  for (const auto& [h, count] : half) {
    CHECK(count == 1);
    const bool edge = h.second == (h.first + 1) % n;
    CHECK(half.count({h.second, h.first}) == (edge ? 0 : 1));
    if (!edge && h.first < h.second) ++inner;
  }
  for (Index i = 0; i < n; ++i) CHECK(half.count({i, (i + 1) % n}) == 1);
  CHECK(int(n) - int(n + inner) + int(t.triangle.size()) == 1);  // Euler characteristic of a disc
}

}  // namespace

TEST_CASE("planar convex polygons have their own area, whatever the metric") {
  for (const PolygonMetric metric : kMetrics)
    for (const bool exact : {true, false}) {
      const auto hexagon = solve(circle(6), metric, exact);
      check_topology(hexagon, 6);
      PolygonOptions area{PolygonMetric::area};
      CHECK(cost_of(circle(6), hexagon.triangle, area) == doctest::Approx(2.598076211353316).epsilon(1e-12));
      const auto round = solve(circle(64), metric, exact);
      check_topology(round, 64);
      CHECK(cost_of(circle(64), round.triangle, area) ==
            doctest::Approx(32 * std::sin(std::numbers::pi / 32)).epsilon(1e-12));
      const bool areas = metric == PolygonMetric::area || metric == PolygonMetric::area_bend;
      CHECK(round.cost == doctest::Approx(areas ? 3.1365484905459393 : 0).epsilon(1e-12));
    }
  for (const Triangles& t : all_triangulations(0, 5))
    CHECK(cost_of(circle(6), t, {PolygonMetric::area}) == doctest::Approx(2.598076211353316).epsilon(1e-12));
}

TEST_CASE("the Petrie hexagon of the cube") {
  CHECK(solve(kPetrie, PolygonMetric::area).cost == doctest::Approx(2.366025403784439).epsilon(1e-12));
  CHECK(solve(kPetrie, PolygonMetric::squared_dihedral).cost == doctest::Approx(2.737890).epsilon(1e-6));
  CHECK(solve(kPetrie, PolygonMetric::worst_dihedral).cost ==
        doctest::Approx(std::acos(1 / std::sqrt(3))).epsilon(1e-12));
}

TEST_CASE("the saddle loop") {
  std::vector<Vec3> loop;
  for (int i = 0; i < 32; ++i) {
    const Real a = 2 * std::numbers::pi * i / 32;
    loop.emplace_back(std::cos(a), std::sin(a), .5 * std::cos(2 * a));
  }
  const auto t = solve(loop, PolygonMetric::area);
  CHECK(t.cost == doctest::Approx(4.169428).epsilon(1e-6));
  check_topology(t, 32);
}

TEST_CASE("the optimum of every metric is that of all triangulations") {
  for (Index n = 5; n <= 8; ++n) {
    const auto all = all_triangulations(0, n - 1);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const auto loop = random_loop(n, 100 * n + seed);
      for (const PolygonMetric metric : kMetrics) {
        const PolygonOptions options{metric};
        Real best = 1e300;
        for (const Triangles& t : all) best = std::min(best, cost_of(loop, t, options));
        const auto found = solve(loop, metric);
        check_topology(found, n);
        CHECK(std::abs(found.cost - best) <= 1e-12 * (1 + best));
        CHECK(std::abs(found.cost - cost_of(loop, found.triangle, options)) <= 1e-12 * (1 + best));
        const auto cheap = solve(loop, metric, false);
        check_topology(cheap, n);
        CHECK(cheap.cost >= best - 1e-12 * (1 + best));
        CHECK(std::abs(cheap.cost - cost_of(loop, cheap.triangle, options)) <= 1e-12 * (1 + best));
      }
    }
  }
}

TEST_CASE("neither direction nor start changes the optimum") {
  const auto loop = random_loop(40, 3);
  for (const PolygonMetric metric : kMetrics) {
    const Real cost = solve(loop, metric).cost;
    CHECK(std::abs(cost - cost_of(loop, solve(loop, metric).triangle, {metric})) <= 1e-12 * cost);
    CHECK(solve(loop, metric, false).cost >= cost * (1 - 1e-12));
    for (const Index start : {1, 7, 39}) {
      auto turned = loop;
      std::rotate(turned.begin(), turned.begin() + start, turned.end());
      CHECK(std::abs(solve(turned, metric).cost - cost) <= 1e-12 * cost);
      std::reverse(turned.begin(), turned.end());
      CHECK(std::abs(solve(turned, metric).cost - cost) <= 1e-12 * cost);
    }
  }
}

TEST_CASE("a cylinder strip is rebuilt across, not along") {
  // Half a cylinder from its border: the cuts across bend, the flat rulings do not cost more than the area.
  std::vector<Vec3> loop;
  for (int i = 0; i <= 16; ++i)
    loop.emplace_back(std::cos(std::numbers::pi * i / 16), std::sin(std::numbers::pi * i / 16), 0);
  for (int i = 16; i >= 0; --i)
    loop.emplace_back(std::cos(std::numbers::pi * i / 16), std::sin(std::numbers::pi * i / 16), 1.5);
  const auto t = solve(loop, PolygonMetric::area_bend);
  CHECK(cost_of(loop, t.triangle, {PolygonMetric::area}) ==
        doctest::Approx(16 * 1.5 * 2 * std::sin(std::numbers::pi / 32)).epsilon(1e-9));
}

TEST_CASE("points without area between them give numbers") {
  // All on a line, all in one place, spikes, repeated points.
  std::vector<Vec3> line, place(9, Vec3(1, 2, 3)), spike = circle(12);
  for (int i = 0; i < 9; ++i) line.emplace_back(i < 5 ? i : 9 - i, 0, 0);
  spike[3] = spike[4] = spike[5], spike[8] = spike[2];
  for (const auto& loop : {line, place, spike})
    for (const PolygonMetric metric : kMetrics)
      for (const bool exact : {true, false}) {
        const auto t = solve(loop, metric, exact);
        check_topology(t, static_cast<Index>(loop.size()));
        CHECK(std::isfinite(t.cost));
      }
  CHECK(solve(place, PolygonMetric::squared_dihedral).cost == 0);
  CHECK(solve(line, PolygonMetric::area).cost == 0);
}

TEST_CASE("nothing to triangulate") {
  CHECK(!solve({}, PolygonMetric::area).ok);
  CHECK(!solve({Vec3(0, 0, 0), Vec3(1, 0, 0)}, PolygonMetric::area).ok);
  const auto one = solve({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, PolygonMetric::area_bend);
  check_topology(one, 3);
  CHECK(one.cost == doctest::Approx(.5));
}

TEST_CASE("copies of one point are never joined, polygon edges never doubled") {
  // A square with a slit from its corner to a point inside: the slit's root stands twice.
  const std::vector<Vec3> p = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 0}, {1, 1, 0}};
  const std::vector<Index> id = {0, 1, 2, 3, 0, 4};
  for (const PolygonMetric metric : kMetrics)
    for (const bool exact : {true, false}) {
      const auto t = solve(p, metric, exact, id);
      check_topology(t, 6);
      for (const auto& c : t.triangle)
        for (std::size_t i = 0; i < 3; ++i) CHECK(id[c[i]] != id[c[(i + 1) % 3]]);
      CHECK(cost_of(p, t.triangle, {PolygonMetric::area}) == doctest::Approx(4).epsilon(1e-12));
    }
  // Every chord of this one joins copies.
  const std::vector<Vec3> flat = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  const std::vector<Index> twice = {0, 1, 0, 1};
  CHECK(!solve(flat, PolygonMetric::area, true, twice).ok);
}

}  // namespace intarsia
