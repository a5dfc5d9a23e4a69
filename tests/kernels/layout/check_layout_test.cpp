#include "kernels/layout/check_layout.h"

#include <limits>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "tests/kernels/layout/layout_case.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

// A valid layout with cut faces, to plant defects in.
struct Planted {
  Mesh mesh;
  RefinedMesh refined;
  std::vector<Index> label;
  Index count;
  LayoutGraph graph;

  explicit Planted(bool sphere = true) {
    Relayout r = relayout(sphere ? identity_case(icosphere(3), Nearest{9}, CurveKind::extension)
                                 : identity_case(jittered(plane(16, 16), 0.01, 1), Nearest{5}, CurveKind::extension));
    REQUIRE(r.match.ok);
    mesh = r.fresh.mesh, refined = r.fresh.refined, label = r.fresh.label, count = r.fresh.count, graph = r.after;
  }
  LayoutChecks check() const { return check_layout(Work(), mesh, refined, label, count, graph); }
  std::set<std::string> failed() const {
    std::set<std::string> names;
    for (const LayoutCheck& c : check().checks)
      if (!c.passed()) names.insert(c.name);
    return names;
  }
  Index inner_edge() const {
    for (Index e = 0; e < refined.mesh.edge_count(); ++e)
      if (!refined.on_network[e]) return e;
    return kNone;
  }
  Index network_edge() const {
    for (Index e = 0; e < refined.mesh.edge_count(); ++e)
      if (refined.on_network[e] && refined.mesh.edge_f1[e] != kNone) return e;
    return kNone;
  }
  Index added_vertex(PointKind kind) const {
    for (Index v = mesh.vertex_count(); v < refined.mesh.vertex_count(); ++v)
      if (refined.origin[v].kind == kind) return v;
    return kNone;
  }
};

using Names = std::set<std::string>;

}  // namespace

TEST_CASE("valid layouts pass every check") {
  for (bool sphere : {true, false}) {
    const Planted p(sphere);
    const LayoutChecks checks = p.check();
    CHECK(checks.is_valid());
    CHECK(p.failed() == Names{});
    CHECK(checks.euler == (sphere ? 2 : 1));
    CHECK(checks.area_error < 1e-12);
    CHECK(checks.checks.size() == 11);
  }
}

TEST_CASE("every planted defect is caught by its check") {
  Planted p;
  SUBCASE("a face without label") {
    p.label[17] = kNone;
    const LayoutChecks c = p.check();
    CHECK(c["faces_labelled"].count == 1);
    CHECK(c["faces_labelled"].example == 17);
    CHECK(!c.is_valid());
  }
  SUBCASE("a patch in two pieces, and one without faces") {
    Index far = 0;
    while (p.label[far] == 0) ++far;
    p.label[far] = 0;
    CHECK(p.check()["patches_connected"].count >= 1);
    CHECK(p.check()["patches_connected"].example == 0);
    Planted q;
    q.count += 1;
    CHECK(q.check()["patches_connected"].example == q.count - 1);
  }
  SUBCASE("a loose end, which is also an edge inside a patch") {
    const MeshView m = p.refined.mesh;
    // An edge with one end on no network edge.
    std::vector<int> degree(m.vertex_count(), 0);
    for (Index e = 0; e < m.edge_count(); ++e)
      if (p.refined.on_network[e]) ++degree[m.edge_v0[e]], ++degree[m.edge_v1[e]];
    Index e = 0;
    while (degree[m.edge_v0[e]] || degree[m.edge_v1[e]]) ++e;
    p.refined.on_network[e] = 1;
    CHECK(p.failed() == Names{"no_loose_ends", "edges_separate"});
    CHECK(p.check()["no_loose_ends"].count == 2);
    CHECK(p.check()["edges_separate"].example == e);
  }
  SUBCASE("a border that is not on the network") {
    const Index e = p.network_edge();
    p.refined.on_network[e] = 0;
    CHECK(p.failed() == Names{"no_loose_ends", "borders_on_network"});
    CHECK(p.check()["borders_on_network"].example == e);
  }
  SUBCASE("a vertex off its place: area and parents") {
    const Index v = p.added_vertex(PointKind::edge);
    REQUIRE(v != kNone);
    p.refined.mesh.x[v] *= 1.01, p.refined.mesh.y[v] *= 1.01, p.refined.mesh.z[v] *= 1.01;
    CHECK(p.failed() == Names{"area", "inside_parent"});
  }
  SUBCASE("a face with a wrong parent") {
    p.refined.parent[3] = p.refined.parent[3] + 1;
    CHECK(p.failed() == Names{"inside_parent", "parents_covered"});
    CHECK(p.check()["inside_parent"].example == 3);
    CHECK(p.check()["parents_covered"].count >= 1);
  }
  SUBCASE("a face turned over") {
    std::swap(p.refined.mesh.corner[3 * 5 + 1], p.refined.mesh.corner[3 * 5 + 2]);
    CHECK(p.check()["inside_parent"].example == 5);
    CHECK(p.check()["parents_covered"].count == 1);
  }
  SUBCASE("a number that is none") {
    p.refined.mesh.y[8] = std::numeric_limits<Real>::quiet_NaN();
    CHECK(p.check()["finite"].count == 1);
    CHECK(p.check()["finite"].example == 8);
    CHECK(!p.check()["area"].passed());
    CHECK(!p.check()["inside_parent"].passed());
  }
  SUBCASE("a graph that is not the one of the labels") {
    p.graph.node.pop_back();
    CHECK(p.failed() == Names{"loops_consistent"});
  }
}

TEST_CASE("patches that are no discs are counted; short holes of the input are not borders") {
  const auto ends = [](const MeshView& m, Index f) {
    const Real z = area_normal(m, f).z();
    return Index(std::abs(z) < 1e-9 ? 0 : z > 0 ? 1 : 2);
  };
  const LayoutCase tube = identity_case(capped_cylinder(0.3, 0.8, 20, 4), ends, CurveKind::sharp);
  const LayoutChecks checks = check_layout(Work(), tube.mesh, tube.refined, tube.label, tube.count, trace(tube));
  CHECK(checks.is_valid());
  CHECK(checks["patches_discs"].count == 1);
  CHECK(checks["patches_discs"].is_warning);
  CHECK(checks["loops_consistent"].passed());

  // A whole torus in one patch is no disc, nor is a sphere.
  for (const Soup& soup : {torus(1, 0.4, 12, 9), icosphere(1)}) {
    const LayoutCase c = identity_case(
        soup, [](const MeshView&, Index) { return Index(0); }, CurveKind::ridge);
    const LayoutChecks whole = check_layout(Work(), c.mesh, c.refined, c.label, c.count, trace(c));
    CHECK(whole.is_valid());
    CHECK(whole["patches_discs"].count == 1);
  }

  // A plane with a hole of one cell (four edges of 1/n).
  for (const auto& [n, discs] : {std::pair{8u, 0u}, std::pair{100u, 1u}}) {
    Soup soup = plane(n, n);
    const std::size_t at = 6 * (std::size_t{n} * (n / 2) + n / 2);
    soup.corner.erase(soup.corner.begin() + static_cast<std::ptrdiff_t>(at),
                      soup.corner.begin() + static_cast<std::ptrdiff_t>(at + 6));
    const LayoutCase c = identity_case(
        soup, [](const MeshView&, Index) { return Index(0); }, CurveKind::ridge);
    const LayoutChecks holed = check_layout(Work(), c.mesh, c.refined, c.label, c.count, trace(c));
    CHECK(holed.is_valid());
    CHECK(holed["patches_discs"].count == 1 - discs);
    CHECK(holed.euler == 0);
  }
}

TEST_CASE("checks do not depend on the number of threads") {
  const LayoutCase c = identity_case(torus(1, 0.4, 120, 60), Nearest{30}, CurveKind::subdivision);
  const LayoutGraph g = trace(c);
  const auto run = [&] { return check_layout(Work(), c.mesh, c.refined, c.label, c.count, g); };
  const LayoutChecks one = run_with_threads(1, run);
  for (int threads : {2, 3, 8}) {
    const LayoutChecks other = run_with_threads(threads, run);
    CHECK(other.area_error == one.area_error);
    for (std::size_t i = 0; i < one.checks.size(); ++i) {
      CHECK(other.checks[i].count == one.checks[i].count);
      CHECK(other.checks[i].example == one.checks[i].example);
    }
  }
}
