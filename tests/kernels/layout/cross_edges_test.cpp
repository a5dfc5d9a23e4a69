#include "kernels/layout/cross_edges.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "kernels/layout/curve_conflicts.h"
#include "tests/kernels/layout/layout_case.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

// What must hold of every result.
void check_curves(const LayoutCase& c, const LayoutGraph& g, const CrossedArcs& x) {
  const CurveNetwork& net = x.network;
  REQUIRE(net.curve_count() == g.arc_count());
  CHECK(find_conflicts(Work(), c.mesh, net).empty());
  CHECK(net.strength.size() == net.point.size());
  for (Index a = 0; a < g.arc_count(); ++a) {
    CHECK(net.kind[a] == g.kind[a]);
    const auto row = net.curve.row(a);
    CHECK((row.front() == row.back()) == g.is_closed(a));
    for (std::size_t i = 1; i < row.size(); ++i)
      CHECK(shared_faces(c.mesh, net.point[row[i - 1]], net.point[row[i]])[0] != kNone);
  }
}

}  // namespace

TEST_CASE("a staircase of mesh edges becomes a straight normal curve") {
  // Slope 1/2 on a regular grid: the chain runs along edges in steps.
  const LayoutCase c = identity_case(
      plane(24, 24),
      [](const MeshView& m, Index f) { return Index(centroid(m, f).y() > 0.25 + centroid(m, f).x() / 2); },
      CurveKind::extension);
  const LayoutGraph g = trace(c);
  SmoothOptions options;
  options.iterations = 200;
  const auto s = smooth_boundaries(Work(), c.mesh, c.refined, g, c.label, {}, options);
  const CrossedArcs x = cross_edges(Work(), c.mesh, c.refined, g, s);
  check_curves(c, g, x);
  CHECK(x.reverted == 0);
  for (Index a = 0; a < g.arc_count(); ++a) {
    if (g.kind[a] != CurveKind::extension) {
      CHECK(x.as_traced[a] == 1);
      CHECK(x.network.curve.row(a).size() == g.arc.row(a).size());
      continue;
    }
    CHECK(x.as_traced[a] == 0);
    const auto row = x.network.curve.row(a);
    const Vec3 p = position(c.mesh, x.network.point[row.front()]), q = position(c.mesh, x.network.point[row.back()]);
    CHECK(length_of(c.mesh, x.network, a) < 1.005 * (q - p).norm());
    CHECK(length_of(c.mesh, x.network, a) < 0.95 * g.length[a]);
    for (std::size_t i = 1; i + 1 < row.size(); ++i) CHECK(x.network.point[row[i]].kind != PointKind::face);
  }
}

TEST_CASE("closed arcs lose their artificial node and stay closed") {
  const LayoutCase c = identity_case(
      icosphere(4), [](const MeshView& m, Index f) { return Index(centroid(m, f).z() > 0.003); },
      CurveKind::subdivision);
  const LayoutGraph g = trace(c);
  const auto s = smooth_boundaries(Work(), c.mesh, c.refined, g, c.label, {});
  const CrossedArcs x = cross_edges(Work(), c.mesh, c.refined, g, s);
  check_curves(c, g, x);
  CHECK(x.reverted == 0);
  for (const SurfacePoint& p : x.network.point) CHECK(p.kind != PointKind::face);
  CHECK(length_of(c.mesh, x.network, 0) == doctest::Approx(2 * std::numbers::pi).epsilon(0.015));
}

TEST_CASE("arcs that are asked to keep their chain keep it") {
  const LayoutCase c = identity_case(jittered(plane(20, 20), 0.01, 4), Nearest{6}, CurveKind::extension);
  const LayoutGraph g = trace(c);
  const auto s = smooth_boundaries(Work(), c.mesh, c.refined, g, c.label, {});
  std::vector<std::uint8_t> keep(g.arc_count(), 0);
  keep[g.arc_count() / 2] = 1;
  for (int round = 0; round < 2; ++round) {
    const CrossedArcs x = cross_edges(Work(), c.mesh, c.refined, g, s, keep);
    check_curves(c, g, x);
    for (Index a = 0; a < g.arc_count(); ++a) {
      if (!keep[a]) continue;
      const auto row = x.network.curve.row(a), chain = g.arc.row(a);
      REQUIRE(row.size() == chain.size());
      for (std::size_t i = 0; i < row.size(); ++i) CHECK(x.network.point[row[i]] == c.refined.origin[chain[i]]);
    }
    keep.assign(g.arc_count(), 1);
  }
}

TEST_CASE("arcs one cell apart do not cross") {
  for (std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    // A band one to two cells wide that follows a wave.
    const LayoutCase c = identity_case(
        jittered(plane(30, 30), 0.012, seed),
        [](const MeshView& m, Index f) {
          const Vec3 p = centroid(m, f);
          const Real d = p.y() - 0.5 - 0.1 * std::sin(7 * p.x());
          return Index(d < -0.02 ? 0 : d < 0.03 ? 1 : 2);
        },
        CurveKind::extension);
    SmoothOptions options;
    options.width_reach = 10;  // let them run into each other
    const Relayout r = relayout(c, {}, options);
    check_curves(c, r.before, r.crossed);
    REQUIRE(r.match.ok);
    CHECK(r.checks.is_valid());
    CHECK(r.after.patch_count() == r.before.patch_count());
  }
}

TEST_CASE("the whole way keeps the layout: labels, arcs, areas") {
  struct Shape {
    const char* name;
    Soup soup;
    Index seeds;
    bool closed;
  };
  const std::vector<Shape> shapes{
      {"plane", jittered(plane(40, 40), 0.008, 1), 12, false},
      {"sphere", icosphere(4), 20, true},
      {"rough sphere", jittered(icosphere(4), 0.012, 9), 20, true},
      {"torus", jittered(torus(1, 0.4, 80, 40), 0.01, 2), 30, true},
      {"cube", cube(12), 14, true},
      {"tube", jittered(cylinder(0.3, 0.3, 1, 40, 30), 0.005, 7), 15, false},
      {"many patches", jittered(icosphere(4), 0.01, 5), 150, true},
  };
  for (const Shape& shape : shapes) {
    CAPTURE(shape.name);
    const LayoutCase c = identity_case(shape.soup, Nearest{shape.seeds}, CurveKind::subdivision);
    const Relayout r = relayout(c);
    REQUIRE(r.match.ok);
    check_curves(c, r.before, r.crossed);
    for (const LayoutCheck& check : r.checks.checks) {
      CAPTURE(check.name);
      if (!check.is_warning) CHECK(check.passed());
    }
    CHECK(r.after.node_count() == r.before.node_count());
    CHECK(r.after.arc_count() == r.before.arc_count());
    CHECK(r.after.loop_count() == r.before.loop_count());
    Real before = 0, after = 0;
    for (Index a = 0; a < r.before.arc_count(); ++a) before += r.before.length[a];
    for (Index a = 0; a < r.after.arc_count(); ++a) after += r.after.length[a];
    CHECK(after < 0.97 * before);
    CHECK(r.crossed.reverted <= r.before.arc_count() / 8);
  }
}

TEST_CASE("crossings do not depend on the number of threads") {
  const LayoutCase c = identity_case(jittered(icosphere(5), 0.006, 2), Nearest{60}, CurveKind::extension);
  const auto one = run_with_threads(1, [&] { return relayout(c); });
  REQUIRE(one.match.ok);
  for (int threads : {2, 3, 8}) {
    const auto r = run_with_threads(threads, [&] { return relayout(c); });
    CHECK(r.crossed.network.point == one.crossed.network.point);
    CHECK(r.crossed.network.curve == one.crossed.network.curve);
    CHECK(r.crossed.network.strength == one.crossed.network.strength);
    CHECK(r.fresh.label == one.fresh.label);
    CHECK(r.fresh.refined.mesh.x == one.fresh.refined.mesh.x);
  }
}
