#include "kernels/layout/smooth_boundaries.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "tests/kernels/layout/layout_case.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

constexpr Index kCells = 24;

// The unit square in cells; vertices of the middle row alternate by a quarter of a cell up and down (amplitude of the
// zigzag: half an edge), except at the ends.
Soup zigzag_plane() {
  Soup s = plane(kCells, kCells);
  for (Index i = 1; i < kCells; ++i) s.y[kCells / 2 * (kCells + 1) + i] += (i % 2 ? 0.25 : -0.25) / kCells;
  return s;
}

Index lower_half(const MeshView&, Index f) { return Index(f / 2 / kCells >= kCells / 2); }

std::vector<Vec3> arc_points(const LayoutCase& c, const LayoutGraph& g, const SmoothedArcs& s, Index a) {
  std::vector<Vec3> p{position(c.mesh, s.node[g.start[a]])};
  for (Index i = s.offset[a]; i < s.offset[a + 1]; ++i) p.push_back(position(c.mesh, s.point[i]));
  p.push_back(position(c.mesh, s.node[g.end[a]]));
  return p;
}

Real length_of(const std::vector<Vec3>& p) {
  Real length = 0;
  for (std::size_t i = 1; i < p.size(); ++i) length += (p[i] - p[i - 1]).norm();
  return length;
}

Index inner_arc(const LayoutGraph& g) {
  for (Index a = 0; a < g.arc_count(); ++a)
    if (g.left[a] != kNone && g.right[a] != kNone) return a;
  return kNone;
}

// Principal directions of a cylinder around z.
PrincipalLines cylinder_lines(const MeshView& m, Real radius) {
  CurvatureFields f;
  f.resize(m.vertex_count());
  for (Index v = 0; v < m.vertex_count(); ++v) {
    const Vec3 n = Vec3(m.x[v], m.y[v], 0).normalized();
    f.normal.set(v, n);
    f.kmax[v] = 1 / radius, f.kmin[v] = 0;
    f.tmax.set(v, (v % 2 ? 1 : -1) * Vec3(-n.y(), n.x(), 0));
    f.tmin.set(v, Vec3(0, 0, v % 3 ? 1 : -1));
    f.status[v] = FitStatus::full, f.direction_ok[v] = 1;
  }
  return principal_lines(Work(), f);
}

}  // namespace

TEST_CASE("a zigzag in the plane becomes its chord") {
  const LayoutCase c = identity_case(zigzag_plane(), lower_half, CurveKind::extension);
  const LayoutGraph g = trace(c);
  const Index a = inner_arc(g);
  REQUIRE(a != kNone);
  SmoothOptions options;
  CHECK(g.length[a] > 1.1);
  SUBCASE("in the default number of steps nearly, the zigzag itself is gone") {
    const auto s = smooth_boundaries(Work(), c.mesh, c.refined, g, c.label, {}, options);
    CHECK(length_of(arc_points(c, g, s, a)) < 1.002);
  }
  SUBCASE("with many steps exactly") {
    options.iterations = 2000;
    const auto s = smooth_boundaries(Work(), c.mesh, c.refined, g, c.label, {}, options);
    const auto points = arc_points(c, g, s, a);
    CHECK(length_of(points) == doctest::Approx(1).epsilon(1e-4));
    for (const Vec3& p : points) CHECK(std::abs(p.y() - 0.5) < 0.01 / kCells);
  }
}

TEST_CASE("a border along a crease stays there though no curve of the network runs along it") {
  // The zigzag becomes the edge of a roof that turns by 90 degrees, or by 30.
  const auto moved_share = [](Real degrees) {
    Soup s = zigzag_plane();
    const Real slope = std::tan(degrees / 2 * std::numbers::pi / 180);
    for (std::size_t v = 0; v < s.x.size(); ++v) {
      const std::size_t row = v / (kCells + 1);
      if (row != kCells / 2) s.z[v] = -slope * std::abs(s.y[v] - 0.5);
    }
    const LayoutCase c = identity_case(std::move(s), lower_half, CurveKind::extension);
    LayoutCase unknown = c;
    std::fill(unknown.refined.on_network.begin(), unknown.refined.on_network.end(), 0);
    const LayoutGraph g = trace(unknown);
    const Index a = inner_arc(g);
    REQUIRE(a != kNone);
    const auto smoothed = smooth_boundaries(Work(), c.mesh, unknown.refined, g, c.label, {}, {});
    Index moved = 0;
    for (Index i = smoothed.offset[a]; i < smoothed.offset[a + 1]; ++i) moved += smoothed.fixed[i] ? 0 : 1;
    return static_cast<Real>(moved) / (smoothed.offset[a + 1] - smoothed.offset[a]);
  };
  CHECK(moved_share(90) == 0);
  CHECK(moved_share(30) == 1);
}

TEST_CASE("no point gets farther from its start than its reach; features less; sharp and border stay") {
  for (CurveKind kind : {CurveKind::subdivision, CurveKind::ridge, CurveKind::sharp}) {
    const Soup soup = jittered(plane(kCells, kCells), 0.3 / kCells, 5);
    const LayoutCase c = identity_case(soup, Nearest{7}, kind);
    const LayoutGraph g = trace(c);
    const auto s = smooth_boundaries(Work(), c.mesh, c.refined, g, c.label, {});
    const MeshView m = c.mesh;
    Real mean = 0;
    for (Index e = 0; e < m.edge_count(); ++e) mean += (m.point(m.edge_v0[e]) - m.point(m.edge_v1[e])).norm();
    mean /= m.edge_count();
    Real farthest = 0;
    for (Index a = 0; a < g.arc_count(); ++a) {
      const auto row = g.arc.row(a);
      for (std::size_t i = 1; i + 1 < row.size(); ++i) {
        const SurfacePoint& p = s.point[s.offset[a] + i - 1];
        const Real moved = (position(m, p) - m.point(row[i])).norm();
        if (g.kind[a] == CurveKind::border || kind == CurveKind::sharp) CHECK(p == SurfacePoint::at_vertex(row[i]));
        farthest = std::max(farthest, moved);
      }
    }
    for (Index n = 0; n < g.node_count(); ++n) {
      const Real moved = (position(m, s.node[n]) - m.point(g.node[n])).norm();
      if (kind != CurveKind::subdivision) CHECK(moved == 0);
      farthest = std::max(farthest, moved);
    }
    if (kind == CurveKind::subdivision) {
      CHECK(farthest > 0.3 * mean);
      CHECK(farthest < 1.35 * mean);  // the local mean edge varies by the jitter
    } else if (kind == CurveKind::ridge) {
      CHECK(farthest > 0.1 * mean);
      CHECK(farthest < 0.4 * mean);
    } else {
      CHECK(farthest == 0);
    }
  }
}

TEST_CASE("on a cylinder arcs follow the nearer principal direction") {
  const Index around = 40, along = 30;
  const Real radius = 0.25, height = 0.8, h = 2 * std::numbers::pi * radius / around;
  // Vertices of one row and one column are moved on the surface, so that the chains there zigzag.
  Soup soup = grid(around, along, true, false, Diagonals::regular, [&](Real u, Real v) {
    const Index i = static_cast<Index>(std::lround(u * around)), j = static_cast<Index>(std::lround(v * along));
    Real a = 2 * std::numbers::pi * u, z = height * v;
    const Real shift = 0.25 * h;
    if (i == 10 && j > 0 && j < along) a += (j % 2 ? shift : -shift) / radius;
    if (j == 15) z += i % 2 ? shift : -shift;
    return Vec3(radius * std::cos(a), radius * std::sin(a), z);
  });
  SmoothOptions options;
  options.iterations = 60;
  SUBCASE("a loop becomes a circle") {
    const LayoutCase c = identity_case(
        soup, [&](const MeshView&, Index f) { return Index(f / 2 / around >= 15); }, CurveKind::extension);
    const LayoutGraph g = trace(c);
    const Index a = inner_arc(g);
    REQUIRE(g.is_closed(a));
    const auto s = smooth_boundaries(Work(), c.mesh, c.refined, g, c.label, cylinder_lines(c.mesh, radius), options);
    for (const Vec3& p : arc_points(c, g, s, a)) CHECK(std::abs(p.z() - height / 2) < 0.05 * h);
    CHECK(length_of(arc_points(c, g, s, a)) == doctest::Approx(2 * std::numbers::pi * radius).epsilon(0.01));
  }
  SUBCASE("a chain along a generator becomes straight") {
    const LayoutCase c = identity_case(
        soup,
        [&](const MeshView&, Index f) {
          const Index i = f / 2 % around;
          return Index(i >= 10 && i < 30);
        },
        CurveKind::subdivision);
    const LayoutGraph g = trace(c);
    const auto s = smooth_boundaries(Work(), c.mesh, c.refined, g, c.label, cylinder_lines(c.mesh, radius), options);
    int found = 0;
    for (Index a = 0; a < g.arc_count(); ++a) {
      if (g.kind[a] != CurveKind::subdivision) continue;
      ++found;
      const auto points = arc_points(c, g, s, a);
      for (const Vec3& p : points) CHECK((p - points.front()).head<2>().norm() < 0.05 * h);
    }
    CHECK(found == 2);
  }
}

TEST_CASE("where principal directions are clear, a slanted arc follows them; elsewhere only its length counts") {
  // Slope 1/3; directions along x and y are clear in the middle third only. The energy of a height profile is then the
  // sum of (1 + 4 c) dy^2: the slope in the middle wants to be a fifth of that outside.
  const LayoutCase c = identity_case(
      plane(30, 30),
      [](const MeshView& m, Index f) { return Index(centroid(m, f).y() > 0.35 + centroid(m, f).x() / 3); },
      CurveKind::extension);
  const LayoutGraph g = trace(c);
  CurvatureFields fields;
  fields.resize(c.mesh.vertex_count());
  for (Index v = 0; v < c.mesh.vertex_count(); ++v) {
    const Real x = c.mesh.x[v];
    fields.kmax[v] = 4, fields.direction_ok[v] = x > 0.33 && x < 0.67;
    fields.tmax.set(v, Vec3(0, v % 2 ? 1 : -1, 0)), fields.tmin.set(v, Vec3(v % 3 ? 1 : -1, 0, 0));
  }
  SmoothOptions options;
  options.iterations = 400;
  const auto middle_rise = [&](const PrincipalLines& with) {
    const auto p =
        arc_points(c, g, smooth_boundaries(Work(), c.mesh, c.refined, g, c.label, with, options), inner_arc(g));
    Real low = 1, high = 0;
    for (const Vec3& q : p)
      if (q.x() > 0.35 && q.x() < 0.65) low = std::min(low, q.y()), high = std::max(high, q.y());
    return high - low;
  };
  CHECK(middle_rise({}) == doctest::Approx(0.3 / 3).epsilon(0.15));
  CHECK(middle_rise(principal_lines(Work(), fields)) < 0.75 * middle_rise({}));
}

TEST_CASE("a great circle stays one and a short loop does not collapse") {
  const LayoutCase c = identity_case(
      icosphere(4), [](const MeshView& m, Index f) { return Index(centroid(m, f).z() > 0.003); },
      CurveKind::subdivision);
  const LayoutGraph g = trace(c);
  const auto s = smooth_boundaries(Work(), c.mesh, c.refined, g, c.label, {});
  const auto points = arc_points(c, g, s, 0);
  CHECK(length_of(points) < 0.999 * g.length[0]);
  CHECK(length_of(points) == doctest::Approx(2 * std::numbers::pi).epsilon(0.015));
  const LayoutCase tiny = identity_case(
      icosphere(4), [](const MeshView& m, Index f) { return Index(m.corner_of(f, 700) < 3); }, CurveKind::subdivision);
  const LayoutGraph t = trace(tiny);
  REQUIRE(t.arc_count() == 1);
  SmoothOptions options;
  options.iterations = 1000;
  const auto u = smooth_boundaries(Work(), tiny.mesh, tiny.refined, t, tiny.label, {}, options);
  CHECK(length_of(arc_points(tiny, t, u, 0)) > 0.5 * t.length[0]);
}

TEST_CASE("smoothed points do not depend on the number of threads") {
  const LayoutCase c = identity_case(jittered(icosphere(4), 0.01, 2), Nearest{25}, CurveKind::extension);
  const LayoutGraph g = trace(c);
  const auto run = [&] { return smooth_boundaries(Work(), c.mesh, c.refined, g, c.label, {}); };
  const auto one = run_with_threads(1, run);
  for (int threads : {2, 3, 8}) {
    const auto s = run_with_threads(threads, run);
    CHECK(s.point == one.point);
    CHECK(s.node == one.node);
  }
}
