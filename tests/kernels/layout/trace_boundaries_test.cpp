#include "kernels/layout/trace_boundaries.h"

#include <algorithm>
#include <numeric>
#include <set>

#include <doctest/doctest.h>

#include "tests/kernels/layout/layout_case.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

Index cube_side(const MeshView& m, Index f) {
  Index axis = 0;
  const Vec3 n = area_normal(m, f);
  n.cwiseAbs().maxCoeff(&axis);
  return 2 * axis + (n[axis] > 0);
}

// Every half-arc with a patch on its left is in exactly one loop of that patch, and loops run head to tail.
void check_loops(const LayoutGraph& g) {
  std::vector<int> seen(2 * g.arc_count(), 0);
  for (Index l = 0; l < g.loop_count(); ++l) {
    const auto row = g.loop.row(l);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const Index h = row[i], k = row[(i + 1) % row.size()];
      ++seen[h];
      CHECK(g.patch_of_half_arc(h) == g.loop_patch[l]);
      CHECK((h % 2 ? g.start[h / 2] : g.end[h / 2]) == (k % 2 ? g.end[k / 2] : g.start[k / 2]));
    }
  }
  for (Index h = 0; h < 2 * g.arc_count(); ++h) CHECK(seen[h] == (g.patch_of_half_arc(h) == kNone ? 0 : 1));
  CHECK(std::is_sorted(g.node.begin(), g.node.end()));
  CHECK(std::is_sorted(g.loop_patch.begin(), g.loop_patch.end()));
  for (Index a = 0; a < g.arc_count(); ++a) {
    CHECK(g.arc.row(a).size() == g.arc_edges.row(a).size() + 1);
    CHECK(g.arc.row(a).front() == g.node[g.start[a]]);
    CHECK(g.arc.row(a).back() == g.node[g.end[a]]);
  }
}

}  // namespace

TEST_CASE("a cube has six patches, eight nodes and twelve arcs, four around each patch") {
  for (Index n : {1u, 2u, 5u}) {
    const LayoutCase c = identity_case(cube(n), cube_side, CurveKind::sharp);
    const LayoutGraph g = trace(c);
    check_loops(g);
    CHECK(c.count == 6);
    CHECK(g.node_count() == 8);
    CHECK(g.arc_count() == 12);
    CHECK(g.loop_count() == 6);
    for (Index l = 0; l < 6; ++l) CHECK(g.loop.row(l).size() == 4);
    for (Index a = 0; a < 12; ++a) {
      CHECK(g.length[a] == doctest::Approx(1).epsilon(1e-12));
      CHECK(g.kind[a] == CurveKind::sharp);
      CHECK(g.left[a] != g.right[a]);
    }
    CHECK(std::accumulate(g.artificial.begin(), g.artificial.end(), 0) == 0);
  }
}

TEST_CASE("the side of a capped cylinder is an annulus: two loops of one closed arc each") {
  const Index around = 24;
  const LayoutCase c = identity_case(
      capped_cylinder(0.3, 0.8, around, 6),
      [](const MeshView& m, Index f) {
        const Real z = area_normal(m, f).z();
        return Index(std::abs(z) < 1e-9 ? 0 : z > 0 ? 1 : 2);
      },
      CurveKind::sharp);
  const LayoutGraph g = trace(c);
  check_loops(g);
  CHECK(c.count == 3);
  CHECK(g.arc_count() == 2);
  CHECK(g.node_count() == 2);
  for (Index n = 0; n < 2; ++n) CHECK(g.artificial[n] == 1);
  CHECK(g.node[0] == 0);  // the smallest vertex of each circle
  CHECK(g.node[1] == 6 * around);
  for (Index a = 0; a < 2; ++a) {
    CHECK(g.is_closed(a));
    CHECK(g.length[a] == doctest::Approx(around * 0.6 * std::sin(std::numbers::pi / around)).epsilon(1e-9));
  }
  std::multiset<std::size_t> loops;
  for (Index p = 0; p < 3; ++p) loops.insert(g.patch_loops.row(p).size());
  CHECK(loops == std::multiset<std::size_t>{1, 1, 2});
}

TEST_CASE("a sphere cut by one closed curve is two discs with an artificial node") {
  const LayoutCase c = identity_case(
      icosphere(3), [](const MeshView& m, Index f) { return Index(centroid(m, f).z() > 0.01); }, CurveKind::extension);
  const LayoutGraph g = trace(c);
  check_loops(g);
  CHECK(c.count == 2);
  CHECK(g.arc_count() == 1);
  CHECK(g.node_count() == 1);
  CHECK(g.artificial[0] == 1);
  const auto row = g.arc.row(0);
  CHECK(g.node[0] == *std::min_element(row.begin(), row.end()));
  CHECK(g.loop_count() == 2);
}

TEST_CASE("a sphere in one piece has neither nodes nor loops") {
  const LayoutCase c = identity_case(
      icosphere(1), [](const MeshView&, Index) { return Index(0); }, CurveKind::ridge);
  const LayoutGraph g = trace(c);
  CHECK(g.node_count() == 0);
  CHECK(g.arc_count() == 0);
  CHECK(g.patch_count() == 1);
  CHECK(g.patch_loops.row(0).empty());
}

TEST_CASE("loops stay inside their patch at a pinch vertex") {
  // Two squares that touch in the middle vertex; the rest surrounds both.
  const LayoutCase c = identity_case(
      plane(8, 8),
      [](const MeshView& m, Index f) {
        const Vec3 p = centroid(m, f);
        if (p.x() > 0.25 && p.x() < 0.5 && p.y() > 0.25 && p.y() < 0.5) return Index(1);
        if (p.x() > 0.5 && p.x() < 0.75 && p.y() > 0.5 && p.y() < 0.75) return Index(2);
        return Index(0);
      },
      CurveKind::extension);
  const LayoutGraph g = trace(c);
  check_loops(g);
  REQUIRE(c.count == 3);
  CHECK(g.node_count() == 5);  // the pinch and the corners of the plane
  CHECK(g.arc_count() == 6);
  const auto loops = g.patch_loops.row(0);
  REQUIRE(loops.size() == 2);
  CHECK(g.loop.row(loops[0]).size() + g.loop.row(loops[1]).size() == 6);
  CHECK(std::min(g.loop.row(loops[0]).size(), g.loop.row(loops[1]).size()) == 2);  // once round both squares
  for (Index p : {1u, 2u}) {
    REQUIRE(g.patch_loops.row(p).size() == 1);
    CHECK(g.loop.row(g.patch_loops.row(p)[0]).size() == 1);
  }
}

TEST_CASE("arcs break where features turn into free curves, and at corners of the boundary") {
  const LayoutCase c = identity_case(
      plane(8, 8), [](const MeshView& m, Index f) { return Index(centroid(m, f).y() > 0.5); },
      [](const MeshView& m, Index e) {
        const Real x = (m.point(m.edge_v0[e]).x() + m.point(m.edge_v1[e]).x()) / 2;
        return x < 0.25   ? CurveKind::ridge
               : x < 0.5  ? CurveKind::valley
               : x < 0.75 ? CurveKind::extension
                          : CurveKind::subdivision;
      });
  const LayoutGraph g = trace(c);
  check_loops(g);
  CHECK(g.node_count() == 4 + 2 + 1);
  CHECK(g.arc_count() == 6 + 2);
  std::multiset<CurveKind> inner;
  for (Index a = 0; a < g.arc_count(); ++a)
    if (g.left[a] != kNone && g.right[a] != kNone) inner.insert(g.kind[a]);
  CHECK(inner == std::multiset<CurveKind>{CurveKind::ridge, CurveKind::extension});  // ties go to the smaller kind
}

TEST_CASE("small round boundary loops have no corners, a hexagon has six") {
  const auto one = [](const MeshView&, Index) { return Index(0); };
  for (Index around : {10u, 16u, 40u}) {
    const LayoutGraph g = trace(identity_case(cylinder(0.2, 0.2, 0.2, around, 3), one, CurveKind::border));
    CHECK(g.node_count() == 2);
    CHECK(g.arc_count() == 2);
    CHECK(g.artificial[0] + g.artificial[1] == 2);
  }
  Soup hexagon;
  const Index centre = add_vertex(hexagon, Vec3::Zero());
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j) {
      const auto corner = [](int k) {
        return Vec3(std::cos(k * std::numbers::pi / 3), std::sin(k * std::numbers::pi / 3), 0);
      };
      add_vertex(hexagon, corner(i) + (corner(i + 1) - corner(i)) * (j / 4.0));
    }
  for (Index i = 0; i < 24; ++i) add_face(hexagon, centre, 1 + i, 1 + (i + 1) % 24);
  // An angle of exactly 60 degrees is on the limit: ask for less.
  const LayoutCase c = identity_case(hexagon, one, CurveKind::border);
  const LayoutGraph g = trace_boundaries(Work(), c.refined, c.label, c.count, {50, 1.5});
  CHECK(g.node_count() == 6);
  CHECK(g.arc_count() == 6);
  CHECK(std::accumulate(g.artificial.begin(), g.artificial.end(), 0) == 0);
}

TEST_CASE("the graph does not depend on the number of threads") {
  const LayoutCase c = identity_case(jittered(torus(1, 0.4, 90, 50), 0.005, 3), Nearest{40}, CurveKind::subdivision);
  const LayoutGraph one = run_with_threads(1, [&] { return trace(c); });
  check_loops(one);
  for (int threads : {2, 3, 8}) {
    const LayoutGraph g = run_with_threads(threads, [&] { return trace(c); });
    CHECK(g.node == one.node);
    CHECK(g.arc == one.arc);
    CHECK(g.loop == one.loop);
    CHECK(g.length == one.length);
    CHECK(g.kind == one.kind);
  }
}
