#include "engine/space/triangulate_loops.h"

#include <cmath>
#include <map>
#include <numbers>

#include <doctest/doctest.h>

namespace intarsia {
namespace {

// Points of a circle around the z axis; turn = -1 runs clockwise seen from above.
void add_circle(std::vector<Vec3>& point, std::vector<Index>& offset, Real x, Real radius, Real z, Index n, int turn,
                Real phase = 0) {
  if (offset.empty()) offset.push_back(0);
  for (Index i = 0; i < n; ++i) {
    const Real a = turn * 2 * std::numbers::pi * i / n + phase;
    point.emplace_back(x + radius * std::cos(a), radius * std::sin(a), z);
  }
  offset.push_back(static_cast<Index>(point.size()));
}

Real area_of(const std::vector<Vec3>& p, const LoopsTriangulation& t) {
  Real area = 0;
  for (const auto& c : t.triangle) area += (p[c[1]] - p[c[0]]).cross(p[c[2]] - p[c[0]]).norm() / 2;
  return area;
}

// Border edges of the triangulation are those of the loops, all other edges have two triangles; V - E + F.
int check_surface(const std::vector<Index>& offset, const LoopsTriangulation& t) {
  REQUIRE(t.ok);
  std::map<std::pair<Index, Index>, int> half;
  for (const auto& c : t.triangle)
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(c[i] != c[(i + 1) % 3]);
      CHECK(++half[{c[i], c[(i + 1) % 3]}] == 1);
    }
  std::map<std::pair<Index, Index>, int> border;
  for (std::size_t l = 0; l + 1 < offset.size(); ++l)
    for (Index p = offset[l]; p < offset[l + 1]; ++p) border[{p, p + 1 < offset[l + 1] ? p + 1 : offset[l]}] = 1;
  int edges = 0;
  for (const auto& [h, count] : half) {
    const bool twin = half.count({h.second, h.first}) == 1;
    CHECK(twin == (border.count(h) == 0));
    edges += twin ? (h.first < h.second ? 1 : 0) : 1;
  }
  for (const auto& [h, one] : border) CHECK(half.count(h) == 1);
  return int(offset.back()) - edges + int(t.triangle.size());
}

}  // namespace

TEST_CASE("a tube between two circles stays a tube") {
  // Long and thin: two discs would have 1/20 of the area.
  for (const PolygonMetric metric :
       {PolygonMetric::area, PolygonMetric::area_bend, PolygonMetric::squared_dihedral, PolygonMetric::worst_dihedral})
    for (const bool exact : {true, false}) {
      std::vector<Vec3> point;
      std::vector<Index> offset;
      add_circle(point, offset, 0, 1, 0, 24, 1);
      add_circle(point, offset, 0, 1, 10, 24, -1);
      PolygonScratch scratch;
      LoopsOptions options;
      options.polygon.metric = metric, options.polygon.exact = exact;
      const auto t = triangulate_loops(point, offset, {}, options, scratch);
      CHECK(t.bridged);
      CHECK(t.triangle.size() == 48);
      CHECK(check_surface(offset, t) == 0);
      const Real cylinder = 24 * 10 * 2 * std::sin(std::numbers::pi / 24);
      if (metric == PolygonMetric::area || metric == PolygonMetric::area_bend)
        CHECK(area_of(point, t) == doctest::Approx(cylinder).epsilon(1e-9));
      else
        CHECK(area_of(point, t) > .8 * cylinder);
    }
}

TEST_CASE("discs with holes have their area") {
  PolygonScratch scratch;
  std::vector<Vec3> point;
  std::vector<Index> offset;
  add_circle(point, offset, 0, 4, 0, 48, 1);
  const auto polygon_area = [](Real radius, Index n) {
    return Real(.5) * n * radius * radius * std::sin(2 * std::numbers::pi / n);
  };
  Real area = polygon_area(4, 48);
  int euler = 1;
  for (const Real x : {-2.0, 0.1, 2.2}) {
    add_circle(point, offset, x, .5, 0, 12, -1, .3);
    area -= polygon_area(.5, 12), --euler;
    for (const PolygonMetric metric : {PolygonMetric::area, PolygonMetric::area_bend}) {
      LoopsOptions options;
      options.polygon.metric = metric;
      const auto t = triangulate_loops(point, offset, {}, options, scratch);
      CHECK(check_surface(offset, t) == euler);
      CHECK(area_of(point, t) == doctest::Approx(area).epsilon(1e-9));
    }
  }
}

TEST_CASE("one loop is a polygon") {
  PolygonScratch scratch;
  std::vector<Vec3> point;
  std::vector<Index> offset;
  add_circle(point, offset, 0, 1, 0, 20, 1);
  const auto t = triangulate_loops(point, offset, {}, {}, scratch);
  CHECK(!t.bridged);
  CHECK(check_surface(offset, t) == 1);
}

TEST_CASE("loops that touch are not bridged where they touch") {
  // The hole's first point is the outer loop's first point.
  PolygonScratch scratch;
  std::vector<Vec3> point;
  std::vector<Index> offset, id;
  add_circle(point, offset, 0, 2, 0, 24, 1);
  add_circle(point, offset, 1, 1, 0, 12, -1);
  for (Index i = 0; i < 36; ++i) id.push_back(i == 24 ? 0 : i);
  const auto t = triangulate_loops(point, offset, id, {}, scratch);
  REQUIRE(t.ok);
  for (const auto& c : t.triangle)
    for (std::size_t i = 0; i < 3; ++i) CHECK(id[c[i]] != id[c[(i + 1) % 3]]);
}

TEST_CASE("many loops stay within the allowed combinations") {
  PolygonScratch scratch;
  std::vector<Vec3> point;
  std::vector<Index> offset;
  add_circle(point, offset, 0, 9, 0, 60, 1);
  for (int h = 0; h < 7; ++h) add_circle(point, offset, 2 * h - 6, .5, 0, 6, -1, .1);
  LoopsOptions options;
  options.combinations = 10;
  options.polygon.metric = PolygonMetric::area;
  const auto t = triangulate_loops(point, offset, {}, options, scratch);
  CHECK(check_surface(offset, t) == -6);
}

}  // namespace intarsia
