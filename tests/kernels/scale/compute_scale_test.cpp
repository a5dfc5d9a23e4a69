#include "kernels/scale/compute_scale.h"

#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "kernels/scale/sample_levels.h"
#include "tests/support/raw_mesh.h"
#include "tests/support/rounded_cube.h"
#include "tests/support/surface.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

// A fillet around the y axis between two flanks that fall off at 45 degrees; vertices h apart in x and y.
Soup fillet(Real radius_in_edges, Real h = 0.01) {
  const Real r = radius_in_edges * h, half = r * std::numbers::sqrt2 / 2;
  return row_grid(120, 40, h, [&](Real x, Real y) {
    const Real a = std::abs(x);
    return Vec3(x, y, a <= half ? std::sqrt(r * r - x * x) : 2 * half - a);
  });
}

ScaleOptions keeping() {
  ScaleOptions o;
  o.keep_variation = true;
  return o;
}

}  // namespace

TEST_CASE("variation and rings on fillets") {
  const std::array<std::array<Real, kRings>, 4> table{{{.27, .50, .63, .71, .76, .80},
                                                       {.07, .27, .43, .53, .61, .66},
                                                       {.02, .07, .17, .28, .37, .44},
                                                       {.00, .02, .04, .07, .12, .17}}};
  const std::array<int, 4> ring{1, 2, 4, 1};  // the table is of another triangulation; the rings agree
  for (std::size_t i = 0; i < 4; ++i) {
    const Real radius = static_cast<Real>(1 << i);
    const Mesh m = raw_mesh(fillet(radius));
    ScaleOptions paper = ScaleOptions::paper();
    paper.keep_variation = true;
    const ScaleFields f = compute_scale(Work{}, m, paper);
    const Index v = nearest_vertex(m, Vec3(0, 0, 0.01 * radius));
    for (std::size_t k = 0; k < kRings; ++k) CHECK(std::abs(f.omega[k][v] - table[i][k]) < 0.06);
    CHECK(f.scale[v] == ring[i]);
    CHECK(f.fit_ring[v] == ring[i]);
    CHECK(f.levels.level.empty());
  }
}

TEST_CASE("the fit has a floor, and a disc where a wide fillet is flat to six rings") {
  const Mesh sharp = raw_mesh(fillet(1));
  const ScaleFields narrow = compute_scale(Work{}, sharp, ScaleOptions{});
  for (Index v = 0; v < sharp.vertex_count(); ++v) CHECK(narrow.fit_ring[v] >= 2);
  const Mesh wide = raw_mesh(fillet(8, 0.004));
  const ScaleFields f = compute_scale(Work{}, wide, keeping());
  const Index v = nearest_vertex(wide, Vec3(0, 0, 0.032));
  CHECK(f.scale[v] == 1);
  REQUIRE(is_disc(f.fit_ring[v]));
  // The disc must cover the half width of the fillet and see about omega_+.
  CHECK(disc_radius(f.fit_ring[v]) > 0.75 * 0.032);
  CHECK(disc_radius(f.fit_ring[v]) < 1.6 * 0.032);
}

TEST_CASE("discs change nothing for vertices that six rings call bent") {
  const TestSurface s = make_surface(RoundedCube{36, 8}.mesh(0.2, 1));
  ScaleOptions without = keeping();
  without.discs = false;
  const ScaleFields a = compute_scale(Work{}, s.mesh, keeping()), b = compute_scale(Work{}, s.mesh, without);
  CHECK(a.scale == b.scale);
  CHECK(a.omega == b.omega);
  Index discs = 0;
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
    if (a.fit_ring[v] != b.fit_ring[v]) {
      discs += is_disc(a.fit_ring[v]);
      int reached = 0;
      for (std::size_t k = 0; k < kRings; ++k) reached += a.omega[k][v] >= 0.1;
      CHECK(2 * reached < kRings);
    }
  }
  CHECK(discs > 0);
}

TEST_CASE("sample levels partition the surface into small connected clusters") {
  const TestSurface s = make_surface(RoundedCube{30, 4}.mesh(0.25, 2));
  const LevelBuild build = build_sample_levels(Work{}, s.mesh, voting_faces(Work{}, s.mesh), 0.15);
  REQUIRE(build.levels.level.size() >= 2);
  Real surface_area = 0;
  for (Real a : s.faces.area) surface_area += a;
  CsrView graph = s.mesh.vertex_vertices;
  Index items = s.mesh.vertex_count();
  for (std::size_t l = 0; l < build.levels.level.size(); ++l) {
    const SampleLevel& level = build.levels.level[l];
    CHECK(level.size() < 0.3 * items);
    Real area = 0, trace = 0;
    for (Index c = 0; c < level.size(); ++c) {
      area += level.area[c];
      trace += build.sums[l].tensor[c][0] + build.sums[l].tensor[c][3] + build.sums[l].tensor[c][5];
      const auto row = level.member.row(c);
      const std::set<Index> member(row.begin(), row.end());
      std::set<Index> met{row.front()};
      std::vector<Index> queue{row.front()};
      for (std::size_t i = 0; i < queue.size(); ++i)
        for (Index w : graph.row(queue[i]))
          if (member.count(w) && met.insert(w).second) queue.push_back(w);
      CHECK(met == member);
      for (Index w : level.neighbours.row(c)) {
        const auto back = level.neighbours.row(w);
        CHECK(w != c);
        CHECK(std::binary_search(back.begin(), back.end(), c));
      }
    }
    CHECK(area == doctest::Approx(surface_area));
    CHECK(trace == doctest::Approx(surface_area));
    graph = level.neighbours;
    items = level.size();
  }
}

TEST_CASE("disc variation follows the shape, not the mesh") {
  // Cylinder: omega is about 0.185 (r / R)^2 for small discs.
  for (Real h : {0.008, 0.004}) {
    const Index n = static_cast<Index>(1.2 / h);
    const Mesh m = raw_mesh(
        row_grid(n, n, h, [](Real x, Real y) { return Vec3(0.4 * std::sin(x / 0.4), y, 0.4 * std::cos(x / 0.4)); }));
    const LevelBuild build = build_sample_levels(Work{}, m, voting_faces(Work{}, m), 0.15);
    DiscWalker walker(build.levels);
    const Index c = build.levels.level[0].parent[nearest_vertex(m, Vec3(0, 0, 0.4))];
    for (int code : {15, 16, 17}) {
      const Real ratio = disc_radius(code) / 0.4;
      CHECK(disc_variation(build, c, code, walker) == doctest::Approx(0.185 * ratio * ratio).epsilon(0.1));
    }
  }
}

TEST_CASE("a plane gets no discs; results do not depend on threads") {
  const TestSurface flat = make_surface(plane(60, 60));
  for (std::uint8_t k : compute_scale(Work{}, flat.mesh, ScaleOptions{}).fit_ring) CHECK(k == 2);

  const TestSurface s = make_surface(RoundedCube{24, 6}.mesh(0.2, 3));
  const auto run = [&] { return compute_scale(Work{}, s.mesh, keeping()); };
  const ScaleFields one = run_with_threads(1, run), three = run_with_threads(3, run);
  CHECK(one.omega == three.omega);
  CHECK(one.scale == three.scale);
  CHECK(one.fit_ring == three.fit_ring);
  REQUIRE(one.levels.level.size() == three.levels.level.size());
  for (std::size_t l = 0; l < one.levels.level.size(); ++l) {
    CHECK(one.levels.level[l].parent == three.levels.level[l].parent);
    CHECK(one.levels.level[l].centre.x == three.levels.level[l].centre.x);
    CHECK(one.levels.level[l].neighbours == three.levels.level[l].neighbours);
  }
}

TEST_CASE("degenerate input has scales too") {
  Soup s = plane(2, 2);
  add_vertex(s, Vec3(4, 4, 4));
  const Index a = add_vertex(s, Vec3(0.5, 0.5, 0)), b = add_vertex(s, Vec3(0.5, 0.5, 0));
  add_face(s, 4, a, b);
  const ScaleFields f = compute_scale(Work{}, raw_mesh(s), keeping());
  for (std::size_t k = 0; k < kRings; ++k)
    for (Real w : f.omega[k]) CHECK(std::abs(w) < 1e-9);
  for (std::uint8_t k : f.scale) CHECK(k == 1);
}
