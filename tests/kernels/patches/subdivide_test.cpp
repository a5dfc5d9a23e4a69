#include "kernels/patches/subdivide.h"

#include <array>
#include <atomic>
#include <numbers>

#include "engine/base/random.h"
#include "kernels/patches/flood_patches.h"
#include "kernels/patches/measure_patches.h"
#include "tests/kernels/patches/patch_checks.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;

namespace {
Subdivision run(const test::TestRefinement& t, const SubdivideOptions& options) {
  return subdivide(Work(), t.refined, t.normal, t.mean_edge, options);
}

// V - E + F of the cell complex of the patches: vertices where borders meet are joined by arcs; with discs as faces
// this is the Euler characteristic of the surface. Computed on all border vertices and edges, which gives the same.
int layout_euler(const MeshView& m, const PatchLabels& labels) {
  int edges = 0;
  std::vector<char> on(m.vertex_count(), 0);
  for (Index e = 0; e < m.edge_count(); ++e)
    if (m.edge_f1[e] == kNone || labels.patch_of_face[m.edge_f0[e]] != labels.patch_of_face[m.edge_f1[e]])
      ++edges, on[m.edge_v0[e]] = on[m.edge_v1[e]] = 1;
  int vertices = 0;
  for (const char c : on) vertices += c;
  return vertices - edges + static_cast<int>(labels.count);
}

// Two tori side by side, joined through a face taken out of each.
Soup double_torus() {
  Soup a = test::torus(1, 0.4, 40, 20);
  Soup b = test::transformed(a, [](const Vec3& p) { return Vec3(3.2 - p.x(), p.y(), -p.z()); });  // half a turn
  const Index hole = 0;  // both have a face at their outermost points, which mirror each other
  const auto drop = [&](Soup& s) {
    std::array<Index, 3> c{s.corner[3 * hole], s.corner[3 * hole + 1], s.corner[3 * hole + 2]};
    s.corner.erase(s.corner.begin() + 3 * hole, s.corner.begin() + 3 * hole + 3);
    return c;
  };
  const Index base = a.vertex_count();
  const auto ca = drop(a), cb = drop(b);
  Soup s = test::joined(a, b);
  // A tube of six triangles between the two open triangles; b's loop runs the other way round.
  const std::array<Index, 3> q{base + cb[0], base + cb[2], base + cb[1]};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    test::add_face(s, ca[i], ca[j], q[j]);
    test::add_face(s, ca[i], q[j], q[i]);
  }
  return s;
}

// A square plate with n x n square holes, every one long enough to count.
Soup sieve(Index n) {
  const Index cells = 3 * n + 2;
  const Soup full = test::plane(2 * cells, 2 * cells);
  Soup s = full;
  s.corner.clear();
  for (Index f = 0; f < full.face_count(); ++f) {
    const Index cell = f / 2, i = cell % (2 * cells) / 2, j = cell / (2 * cells) / 2;
    if (i % 3 == 2 && j % 3 == 2) continue;
    s.corner.insert(s.corner.end(), full.corner.begin() + 3 * f, full.corner.begin() + 3 * f + 3);
  }
  return s;
}

void check_valid(const test::TestRefinement& t, const Subdivision& r, bool discs) {
  const MeshView m = t.refined.mesh.view();
  CHECK(test::is_connected(m, r.labels));
  if (discs) {
    CHECK(r.not_discs == 0);
    for (Index p = 0; p < r.labels.count; ++p) CHECK(r.table.is_disc(p));
  }
  bool marks = true;
  for (Index e = 0; e < m.edge_count(); ++e) {
    const bool border =
        m.is_boundary_edge(e) || r.labels.patch_of_face[m.edge_f0[e]] != r.labels.patch_of_face[m.edge_f1[e]];
    marks = marks && border == (r.on_network[e] != 0);
    if (border && !t.refined.on_network[e]) marks = marks && r.edge_kind[e] == CurveKind::subdivision;
    if (border && t.refined.on_network[e]) marks = marks && r.edge_kind[e] == t.refined.edge_kind[e];
  }
  CHECK(marks);
}
}  // namespace

TEST_CASE("closed surfaces without a network become discs with the right Euler characteristic") {
  const std::vector<std::pair<Soup, int>> shapes{
      {test::icosphere(4), 2}, {test::torus(1, 0.4, 60, 30), 0}, {double_torus(), -2}};
  for (const auto& [soup, euler] : shapes) {
    const auto t = test::identity_refinement(soup, test::nowhere);
    for (const bool rule : {true, false}) {
      SubdivideOptions options = robust_subdivision();
      if (!rule) options.split.max_spread = 4;  // discs by cuts alone
      const auto r = run(t, options);
      check_valid(t, r, true);
      CHECK(layout_euler(t.refined.mesh.view(), r.labels) == euler);
      CHECK(r.labels.count <= 24);
      CHECK(r.warnings.empty());
    }
  }
}

TEST_CASE("cuts alone make few parts") {
  const auto parts = [](const Soup& soup) {
    const auto t = test::identity_refinement(soup, test::nowhere);
    const auto s = test::surface_of(t);
    return cut_to_discs(Work(), s, flood_patches(Work(), s.mesh, t.refined.on_network), {}).count;
  };
  CHECK(parts(test::plane(20, 20)) == 1);
  CHECK(parts(test::cylinder(1, 1, 3, 48, 40)) == 2);
  CHECK(parts(test::icosphere(3)) == 2);
  CHECK(parts(test::torus(1, 0.4, 60, 30)) <= 4);
  CHECK(parts(sieve(1)) == 2);
  CHECK(parts(sieve(4)) <= 6);
}

TEST_CASE("a plate with many holes ends as discs; pinholes count as filled") {
  const auto t = test::identity_refinement(sieve(5), test::nowhere);
  SubdivideOptions options;
  options.hole_length = 0;
  const auto r = run(t, options);
  check_valid(t, r, true);
  CHECK(r.labels.count >= 2);
  CHECK(layout_euler(t.refined.mesh.view(), r.labels) == 1 - 25);
  options.hole_length = 1;
  const auto filled = run(t, options);
  CHECK(filled.labels.count == 1);
  CHECK(filled.table.filled_holes[0] == 25);
}

TEST_CASE("any number of patches on several shapes") {
  const std::vector<Soup> shapes{test::icosphere(4), test::cube(12), test::ellipsoid(4, 3, 2, 1), sieve(1),
                                 test::plane(40, 40)};
  for (const Soup& soup : shapes) {
    const auto t = test::sharp_refinement(soup, 0.7);
    for (const Index wanted : {2u, 7u, 40u, 150u}) {
      SubdivideOptions options;
      options.patches = wanted;
      const auto r = run(t, options);
      CHECK(r.labels.count == wanted);
      CHECK(r.warnings.empty());
      check_valid(t, r, true);
      options = paper_subdivision(3);
      options.patches = wanted;
      const auto paper = run(t, options);
      CHECK(paper.labels.count == wanted);
      check_valid(t, paper, false);
    }
  }
  const auto torus = test::identity_refinement(test::torus(1, 0.4, 60, 30), test::nowhere);
  for (const Index wanted : {12u, 40u, 150u}) {
    SubdivideOptions options;
    options.patches = wanted;
    const auto r = run(torus, options);
    CHECK(r.labels.count == wanted);
    check_valid(torus, r, true);
  }
}

TEST_CASE("numbers that cannot be reached end at the nearest one, with the reason") {
  const auto t =
      test::identity_refinement(test::joined(test::plane(6, 6), test::scaled(test::icosphere(1), 0.2)), test::nowhere);
  SubdivideOptions options;
  options.patches = 1;
  auto r = run(t, options);
  CHECK(r.labels.count == 3);  // a sphere needs two discs
  REQUIRE(r.warnings.size() == 1);
  CHECK(r.warnings[0].find("2 components") != std::string::npos);
  options.patches = 1000;
  r = run(t, options);
  CHECK(r.labels.count == 72 + 80);
  REQUIRE(r.warnings.size() == 1);
  CHECK(r.warnings[0].find("152 faces") != std::string::npos);
}

TEST_CASE("every number up to the faces is reached with discs") {
  const auto t = test::identity_refinement(test::icosphere(1), test::nowhere);
  for (Index wanted = 2; wanted <= 80; ++wanted) {
    SubdivideOptions options;
    options.patches = wanted;
    const auto r = run(t, options);
    CHECK(r.labels.count == wanted);
    CHECK(r.not_discs == 0);
  }
}

TEST_CASE("random networks: valid, the same for any number of threads") {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Soup soup =
        seed % 2 ? test::torus(1, 0.4, 80, 40) : test::height_field(70, 70, 0, 1, 0, 1, [](Real x, Real y) {
          return 0.15 * std::sin(9 * x) * std::cos(11 * y);
        });
    const auto t = test::identity_refinement(
        test::shuffle(soup, seed), [&](const MeshView&, Index e) { return Random(seed, 4).uniform(e) < 0.45; });
    SubdivideOptions options;
    options.patches = seed < 4 ? 0 : 60;
    const auto r = run(t, options);
    check_valid(t, r, true);
    CHECK(r.network_patches > r.merged_patches);
    for (const int threads : {1, 2, 3, 8}) {
      const auto again = test::run_with_threads(threads, [&] { return run(t, options); });
      CHECK(again.labels == r.labels);
      CHECK(again.table.area == r.table.area);
    }
  }
}

TEST_CASE("faces without area do no harm") {
  Soup soup = test::plane(20, 20);
  for (Index i = 0; i <= 20; ++i) soup.y[21 * 10 + i] = soup.y[21 * 9 + i];  // a row of cells of no height
  const auto t = test::identity_refinement(soup, test::nowhere);
  SubdivideOptions options;
  options.patches = 9;
  const auto r = run(t, options);
  CHECK(r.labels.count == 9);
  check_valid(t, r, true);
  for (const Real a : r.table.area) CHECK(std::isfinite(a));
}

TEST_CASE("a cancelled run throws") {
  const auto t = test::identity_refinement(test::icosphere(4), test::nowhere);
  const std::atomic<bool> cancel{true};
  const Work work(&cancel, nullptr, Order::fixed);
  CHECK_THROWS_AS(subdivide(work, t.refined, t.normal, t.mean_edge, {}), Error);
}
