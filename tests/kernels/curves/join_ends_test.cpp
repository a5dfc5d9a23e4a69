#include "kernels/curves/join_ends.h"

#include <algorithm>
#include <numbers>

#include <doctest/doctest.h>

#include "kernels/curves/gap_path.h"
#include "kernels/curves/tidy_curves.h"
#include "tests/kernels/curves/curve_case.h"

using namespace intarsia;
using namespace intarsia::test;
using kernels::EndFrame;
using kernels::join_angle;
using kernels::join_ends;

namespace {

constexpr Real kDegree = std::numbers::pi / 180;

Vec3 heading(Real degrees) { return {std::cos(degrees * kDegree), std::sin(degrees * kDegree), 0}; }

// a at the origin, b one to the right; a leaves turned by alpha, b by beta (both to the same or to opposite sides).
bool joins(Real alpha, Real beta, bool same_side, const Vec3& normal_b = Vec3(0, 0, 1)) {
  const EndFrame a{Vec3::Zero(), heading(alpha), Vec3(0, 0, 1)};
  const EndFrame b{Vec3(1, 0, 0), heading(same_side ? 180 - beta : 180 + beta), normal_b};
  return join_angle(a, b, {}) >= 0;
}

}  // namespace

TEST_CASE("which ends continue each other") {
  CHECK(joins(0, 0, true));
  CHECK(joins(59, 0, true));
  CHECK_FALSE(joins(61, 0, true));
  CHECK(joins(0, 59, true));
  CHECK_FALSE(joins(0, 61, true));
  CHECK(joins(60, 0, true));
  CHECK(joins(60, 60, false));  // an S: in and out in the same direction
  CHECK(joins(44.5, 44.5, true));
  CHECK_FALSE(joins(45.5, 45.5, true));  // gamma = 91
  CHECK_FALSE(joins(0, 0, true, Vec3(0, 0, -1)));
  const EndFrame a{Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 0, 1)};
  const EndFrame beside{Vec3(0, 0.1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)};
  CHECK(join_angle(a, beside, {}) < 0);  // neighbours that run side by side
  const EndFrame here{Vec3::Zero(), heading(180 - 80), Vec3(0, 0, 1)};
  CHECK(join_angle(a, here, {}) == doctest::Approx(80 * kDegree));
}

TEST_CASE("a collinear gap is closed over mesh vertices, a wide one is not, one across another curve is not") {
  const TestSurface s = make_surface(plane(20, 20));
  // Edges of the grid: 1 and 1.41 cells, mean 1.14.
  const auto case_of = [&](int gap, bool wall) {
    FeatureCurves c;
    draw(c, grid_row(s, 2, 8, 10, 20));
    draw(c, grid_row(s, 8 + gap, 17, 10, 20));
    if (wall) {
      std::vector<Index> column;
      for (int y = 0; y <= 20; ++y) column.push_back(vertex_near(s, Vec3(0.5, y / 20.0, 0)));
      draw(c, column, CurveKind::valley, true);
    }
    join_ends({}, s.mesh, s.mean_edge, {}, c);
    return c;
  };
  const FeatureCurves joined = case_of(3, false);
  REQUIRE(joined.curve_count() == 1);
  CHECK(joined.points_of(0).size() == 16);
  CHECK(kernels::curve_length(s.mesh, joined, 0) * s.box.diagonal == doctest::Approx(0.75));
  for (Index p : joined.points_of(0)) CHECK(joined.kd[p] == doctest::Approx(3));
  CHECK(case_of(5, false).curve_count() == 2);
  CHECK(case_of(3, true).curve_count() == 3);
}

TEST_CASE("channels stay apart; a ridge and a convex sharp edge share a point but keep their kinds") {
  const TestSurface s = make_surface(plane(20, 20));
  FeatureCurves apart;
  draw(apart, grid_row(s, 2, 8, 10, 20));
  draw(apart, grid_row(s, 10, 17, 10, 20), CurveKind::valley, true);
  join_ends({}, s.mesh, s.mean_edge, {}, apart);
  CHECK(apart.curve_count() == 2);
  FeatureCurves mixed;
  draw(mixed, grid_row(s, 2, 8, 10, 20));
  draw(mixed, grid_row(s, 10, 17, 10, 20), CurveKind::sharp, false);
  join_ends({}, s.mesh, s.mean_edge, {}, mixed);
  REQUIRE(mixed.curve_count() == 2);
  const auto uses = kernels::point_uses(mixed);
  CHECK(std::count(uses.begin(), uses.end(), 1) == 2);
  CHECK(std::count(mixed.net.kind.begin(), mixed.net.kind.end(), CurveKind::sharp) == 1);
}

TEST_CASE("an almost closed curve closes itself where it would not bend too much") {
  const TestSurface s = make_surface(plane(40, 40));
  const auto arc = [&](int size, int gap) {
    FeatureCurves c;
    std::vector<Index> v;
    const auto at = [&](int x, int y) { v.push_back(vertex_near(s, Vec3(x / 40.0, y / 40.0, 0))); };
    for (int i = gap; i < size; ++i) at(10 + i, 10);
    for (int i = 0; i < size; ++i) at(10 + size, 10 + i);
    for (int i = size; i > 0; --i) at(10 + i, 10 + size);
    for (int i = size; i >= 0; --i) at(10, 10 + i);
    draw(c, v);
    join_ends({}, s.mesh, s.mean_edge, {}, c);
    return c;
  };
  const FeatureCurves ring = arc(10, 3);
  REQUIRE(ring.curve_count() == 1);
  CHECK(ring.net.is_closed(0) == false);  // it would turn by 90 degrees at the gap and alpha is too large
  FeatureCurves line;
  std::vector<Index> v = grid_row(s, 12, 30, 10, 40);
  for (int y = 11; y < 30; ++y) v.push_back(vertex_near(s, Vec3(30 / 40.0, y / 40.0, 0)));
  for (int x = 30; x > 10; --x) v.push_back(vertex_near(s, Vec3(x / 40.0, 30 / 40.0, 0)));
  for (int y = 30; y > 11; --y) v.push_back(vertex_near(s, Vec3(10 / 40.0, y / 40.0, 0)));
  draw(line, v);
  join_ends({}, s.mesh, s.mean_edge, {}, line);
  REQUIRE(line.curve_count() == 1);
  CHECK(line.net.is_closed(0));
}

TEST_CASE("the path over the mesh avoids what is used and gives up beyond its limit") {
  const TestSurface s = make_surface(plane(10, 10));
  std::vector<std::uint8_t> vertex(s.mesh.vertex_count(), 0), edge(s.mesh.edge_count(), 0);
  const auto at = [&](int x, int y) { return vertex_near(s, Vec3(x / 10.0, y / 10.0, 0)); };
  std::vector<Index> path;
  const auto p = SurfacePoint::at_vertex(at(2, 5)), q = SurfacePoint::at_vertex(at(6, 5));
  vertex[p.element] = vertex[q.element] = 1;
  const Real cell = 0.1 / s.box.diagonal;
  REQUIRE(kernels::gap_path(s.mesh, vertex, edge, p, q, 6 * cell, path));
  CHECK(path == std::vector<Index>{at(3, 5), at(4, 5), at(5, 5)});
  vertex[at(4, 5)] = 1;
  REQUIRE(kernels::gap_path(s.mesh, vertex, edge, p, q, 6 * cell, path));
  CHECK(std::find(path.begin(), path.end(), at(4, 5)) == path.end());
  CHECK_FALSE(kernels::gap_path(s.mesh, vertex, edge, p, q, 4.1 * cell, path));
  CHECK(path.empty());
  CHECK(kernels::gap_path(s.mesh, vertex, edge, p, SurfacePoint::at_vertex(at(3, 5)), cell, path));
  CHECK(path.empty());
}
