#include "kernels/ridges/sharp_edges.h"

#include <algorithm>
#include <numbers>

#include <doctest/doctest.h>

#include "tests/support/quadric_fields.h"

using namespace intarsia;
using namespace intarsia::test;
using kernels::sharp_edges;
using kernels::SharpOptions;

namespace {

// A square folded along x = 0 by `turn` radians, `cells` to a side; convex or concave seen from above.
Soup folded(Real turn, Index cells, bool convex) {
  const Real slope = std::tan(turn / 2) * (convex ? -1 : 1);
  return height_field(2 * cells, 2 * cells, -1, 1, -1, 1, [&](Real x, Real) { return slope * std::abs(x); });
}

}  // namespace

TEST_CASE("a cube has twelve sharp curves that meet at eight corners") {
  for (const Index n : {4u, 7u}) {
    const TestSurface s = make_surface(cube(n));
    const auto sharp = sharp_edges({}, s.mesh, s.mean_edge, {});
    CHECK(sharp.curves.curve_count() == 12);
    CHECK(sharp.edge.size() == 12 * n);
    std::vector<int> ends(sharp.curves.point_count(), 0);
    for (Index c = 0; c < sharp.curves.curve_count(); ++c) {
      CHECK(sharp.curves.points_of(c).size() == n + 1);
      CHECK(sharp.curves.concave[c] == 0);
      CHECK(sharp.curves.net.kind[c] == CurveKind::sharp);
      ++ends[sharp.curves.points_of(c).front()], ++ends[sharp.curves.points_of(c).back()];
    }
    CHECK(std::count(ends.begin(), ends.end(), 3) == 8);
    for (Real turn : sharp.curves.turn()) CHECK(turn == doctest::Approx(std::numbers::pi / 2));
    CHECK(total_length(s.mesh, sharp.curves.net) * s.box.diagonal == doctest::Approx(12));
  }
}

TEST_CASE("convex and concave folds, and folds below the limit") {
  const Real degree = std::numbers::pi / 180;
  for (const bool convex : {true, false}) {
    const TestSurface s = make_surface(folded(90 * degree, 8, convex));
    const auto sharp = sharp_edges({}, s.mesh, s.mean_edge, {});
    REQUIRE(sharp.curves.curve_count() == 1);
    CHECK(sharp.curves.concave[0] == (convex ? 0 : 1));
    const auto& near = convex ? sharp.near_convex : sharp.near_concave;
    const auto& other = convex ? sharp.near_concave : sharp.near_convex;
    CHECK(std::count(near.begin(), near.end(), 1) == 3 * 17);
    CHECK(std::count(other.begin(), other.end(), 1) == 0);
    for (Index p : sharp.curves.points_of(0)) {
      CHECK(std::abs(sharp.curves.across[p].x()) > 0.99);
      CHECK(sharp.curves.normal[p].z() > 0.99);
    }
  }
  const TestSurface at = make_surface(folded(61 * degree, 8, true)), below = make_surface(folded(59 * degree, 8, true));
  CHECK(sharp_edges({}, at.mesh, at.mean_edge, {}).curves.curve_count() == 1);
  CHECK(sharp_edges({}, below.mesh, below.mean_edge, {}).curves.curve_count() == 0);
  SharpOptions off;
  off.enabled = false;
  CHECK(sharp_edges({}, at.mesh, at.mean_edge, off).curves.curve_count() == 0);
}

TEST_CASE("a fold that flattens out is followed below the limit, but not to the end") {
  // The turn falls from 90 degrees at y = -1 to 0 at y = 1: sharp from 60 on, continued down to 30.
  const Real degree = std::numbers::pi / 180;
  const TestSurface s = make_surface(height_field(
      40, 40, -1, 1, -1, 1, [&](Real x, Real y) { return -std::tan(45 * degree * (1 - y) / 2) * std::abs(x); }));
  const auto length_at = [&](Real weak) {
    SharpOptions options;
    options.weak = weak;
    const auto sharp = sharp_edges({}, s.mesh, s.mean_edge, options);
    CHECK(sharp.curves.curve_count() == 1);
    return total_length(s.mesh, sharp.curves.net) * s.box.diagonal;
  };
  CHECK(length_at(60 * degree) == doctest::Approx(2.0 / 3).epsilon(0.1));
  CHECK(length_at(30 * degree) == doctest::Approx(4.0 / 3).epsilon(0.1));
}

TEST_CASE("smooth surfaces, small bumps and flat triangles give no sharp edges") {
  const TestSurface sphere = make_surface(icosphere(3));
  CHECK(sharp_edges({}, sphere.mesh, sphere.mean_edge, {}).edge.empty());
  // One raised vertex: six steep edges to it and six around, 0.3 in all.
  Soup spike = plane(60, 60);
  spike.z[30 * 61 + 30] = 0.05;
  const TestSurface s = make_surface(spike);
  SharpOptions longer;
  longer.min_length = 0.3;
  CHECK(sharp_edges({}, s.mesh, s.mean_edge, longer).edge.empty());
  SharpOptions more;
  more.min_edges = 13;
  CHECK(sharp_edges({}, s.mesh, s.mean_edge, more).edge.empty());
  CHECK(sharp_edges({}, s.mesh, s.mean_edge, {}).edge.size() >= 6);
  Soup flat = plane(6, 6);
  const Index v = add_vertex(flat, Vec3(0.5, 0.0, 0));  // on an edge of the square: a triangle without area
  flat.corner.insert(flat.corner.end(), {3, 2, v});
  Mesh mesh;
  mesh.x = flat.x, mesh.y = flat.y, mesh.z = flat.z, mesh.corner = flat.corner;
  connect_mesh({}, mesh);
  CHECK(sharp_edges({}, mesh, 0.1, {}).edge.empty());
}

TEST_CASE("corners cut a chain, a convex-concave change cuts a chain, threads do not matter") {
  // An L-shaped fold: a square plateau with walls has four convex corners above and concave ones below.
  const TestSurface s = make_surface(height_field(20, 20, 0, 1, 0, 1, [](Real x, Real y) {
    return std::max(std::abs(x - 0.5), std::abs(y - 0.5)) < 0.22 ? 0.2 : 0.0;
  }));
  const auto one = run_with_threads(1, [&] { return sharp_edges({}, s.mesh, s.mean_edge, {}); });
  const auto three = run_with_threads(3, [&] { return sharp_edges({}, s.mesh, s.mean_edge, {}); });
  CHECK(one.edge == three.edge);
  CHECK(one.curves.net.curve == three.curves.net.curve);
  CHECK(one.curves.net.point == three.curves.net.point);
  int convex = 0, concave = 0;
  for (Index c = 0; c < one.curves.curve_count(); ++c) {
    const auto row = one.curves.points_of(c);
    (one.curves.concave[c] ? concave : convex) += 1;
    for (std::size_t i = 1; i + 1 < row.size(); ++i) {
      const auto at = [&](std::size_t k) { return position(s.mesh, one.curves.net.point[row[k]]); };
      const Vec3 a = (at(i) - at(i - 1)).normalized(), b = (at(i + 1) - at(i)).normalized();
      CHECK(a.dot(b) > std::cos(0.786));
    }
  }
  CHECK(convex >= 4);
  CHECK(concave >= 4);
}
