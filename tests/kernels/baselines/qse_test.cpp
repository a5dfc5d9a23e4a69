#include "kernels/baselines/qse.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include <doctest/doctest.h>

#include "tests/support/baseline_checks.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;

namespace {

struct Case {
  Mesh mesh;
  FaceGraph graph;
};
Case case_of(const Soup& soup) { return {test::raw_mesh(soup), test::face_graph(soup)}; }

// A closed cylinder of radius 0.3 and height 1: side and two caps, made from a cube by mapping its squares to discs.
Soup capped_cylinder() {
  return test::transformed(test::cube(20), [](const Vec3& p) {
    const Real x = 2 * p.x() - 1, y = 2 * p.y() - 1, most = std::max(std::abs(x), std::abs(y));
    const Real length = std::hypot(x, y);
    return length > 0 ? Vec3(0.3 * x * most / length, 0.3 * y * most / length, p.z()) : Vec3(0, 0, p.z());
  });
}

}  // namespace

TEST_CASE("a capped cylinder is three quadrics: the side and the caps") {
  const Case c = case_of(capped_cylinder());
  const QseFit fit = fit_quadrics(Work(), c.mesh, c.graph, {.patches = 3});
  REQUIRE(fit.count() == 3);
  std::map<Index, std::set<int>> sides;  // region -> -1 bottom, 0 side, 1 top
  for (Index f = 0; f < c.graph.faces(); ++f)
    sides[fit.region[f]].insert(static_cast<int>(std::lround(c.graph.normal[f].z())));
  for (const auto& [region, where] : sides) CHECK(where.size() == 1);
  std::multiset<QuadricType> types;
  for (const Quadric& q : fit.quadric) types.insert(q.type);
  CHECK(types == std::multiset<QuadricType>{QuadricType::plane, QuadricType::plane, QuadricType::cylinder});
}

TEST_CASE("pieces of one quadric become one where asked for") {
  const Case c = case_of(capped_cylinder());
  const QseFit fit = fit_quadrics(Work(), c.mesh, c.graph, {.patches = 9, .same_within = 0.02});
  CHECK(fit.count() == 3);
  CHECK(test::pieces_equal_regions(c.graph, fit.region, fit.count()));
}

TEST_CASE("a sphere beside a box: one quadric and six") {
  const Case c = case_of(test::side_by_side(test::icosphere(4), test::cube(8)));
  const QseFit fit = fit_quadrics(Work(), c.mesh, c.graph, {.patches = 7});
  REQUIRE(fit.count() == 7);
  CHECK(test::pieces_equal_regions(c.graph, fit.region, 7));
  const Index sphere = fit.region[0];
  CHECK(fit.quadric[sphere].type == QuadricType::sphere);
  for (Index f = 0; f < c.graph.faces(); ++f) CHECK((fit.region[f] == sphere) == (f < 20 * 256));
}

TEST_CASE("every region connected; labels do not depend on threads") {
  const Case c = case_of(test::jittered(test::torus(1, 0.4, 50, 24), 0.01, 5));
  const auto run = [&](int threads) {
    return test::run_with_threads(threads, [&] { return fit_quadrics(Work(), c.mesh, c.graph, {.patches = 11}); });
  };
  const QseFit one = run(1);
  CHECK(one.count() == 11);
  CHECK(test::pieces_equal_regions(c.graph, one.region, 11));
  CHECK(run(2).region == one.region);
  CHECK(run(5).region == one.region);
}
