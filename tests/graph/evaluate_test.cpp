#include "graph/evaluate.h"

#include <cmath>
#include <numbers>

#include "tests/kernels/quality/quality_case.h"

namespace intarsia {

using namespace test;

namespace {

graph::EvaluateOptions quick() {
  graph::EvaluateOptions o;
  o.sample.loop_samples = 80;
  o.distance.samples = 20000;
  return o;
}

graph::Evaluation evaluated(const LayoutCase& c, const graph::EvaluateOptions& options = quick()) {
  return graph::evaluate(Work(), c.mesh, c.refined, c.label, trace(c), options);
}

}  // namespace

TEST_CASE("a cube's layout rebuilds the cube, and its patches are squares") {
  graph::EvaluateOptions options = quick();
  options.make_triangulated_area = true;
  const graph::Evaluation e = evaluated(identity_case(cube(10), cube_side, CurveKind::sharp), options);
  CHECK(e.patches == 6);
  CHECK(e.not_discs == 0);
  const auto made = e.made();
  REQUIRE(made.size() == 4);
  CHECK(made[0].first == "triangulated");
  CHECK(made[3].first == "filled");
  for (const auto& [name, r] : made) {
    CHECK(r->failed == 0);
    CHECK(r->distance.hausdorff() < 1e-9);
    REQUIRE(r->patch.size() == 6);
    for (const auto& p : r->patch) CHECK(p.area == doctest::Approx(1));
  }
  const Real square = 16 / (4 * std::numbers::pi);
  CHECK(e.compactness.median == doctest::Approx(square));
  CHECK(e.compactness.high == doctest::Approx(square));
  CHECK(e.compactness.most == doctest::Approx(square));
}

TEST_CASE("tangents bring a sphere's fill closer; only what was asked for is made") {
  const LayoutCase c = identity_case(octasphere(24), octant, CurveKind::subdivision);
  graph::EvaluateOptions options = quick();
  options.make_transfinite = false;
  const graph::Evaluation e = evaluated(c, options);
  CHECK(e.made().size() == 2);
  CHECK(!e.transfinite.made);
  CHECK(e.filled.distance.rms() < .3 * e.triangulated.distance.rms());
  // An octant has three sides of pi / 2 and an area of pi / 2.
  const Real q = std::pow(1.5 * std::numbers::pi, 2) / (4 * std::numbers::pi * std::numbers::pi / 2);
  CHECK(e.compactness.median == doctest::Approx(q).epsilon(.01));
}

TEST_CASE("patches that are no discs are counted; a lid is as compact as can be") {
  const LayoutCase c = identity_case(
      capped_cylinder(1, 3, 64, 20),
      [](const MeshView& m, Index f) {
        const Real z = centroid(m, f).z();
        return z < 1e-9 ? 0u : z > 3 - 1e-9 ? 2u : 1u;
      },
      CurveKind::sharp);
  const graph::Evaluation e = evaluated(c);
  CHECK(e.not_discs == 1);
  CHECK(e.triangulated.surface.bridged_count() == 1);
  std::vector<Real> q = e.compactness.patch;
  std::sort(q.begin(), q.end());
  CHECK(q[0] == doctest::Approx(2.0 / 3).epsilon(.01));  // the tube: (4 pi)^2 / (4 pi 6 pi)
  CHECK(q[1] == doctest::Approx(1).epsilon(.01));
  CHECK(q[2] == doctest::Approx(1).epsilon(.01));
  CHECK(e.compactness.most == q[2]);
}

TEST_CASE("a surface without curves is refused") {
  const LayoutCase c = identity_case(
      icosphere(2), [](const MeshView&, Index) { return 0u; }, CurveKind::sharp);
  CHECK_THROWS_AS(evaluated(c), Error);
}

TEST_CASE("an evaluation does not depend on threads") {
  const LayoutCase c = identity_case(torus(2, .8, 64, 32), Nearest{19}, CurveKind::subdivision);
  const graph::Evaluation one = run_with_threads(1, [&] { return evaluated(c); });
  const graph::Evaluation four = run_with_threads(4, [&] { return evaluated(c); });
  const auto a = one.made(), b = four.made();
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(same(a[i].second->surface, b[i].second->surface));
    CHECK(a[i].second->distance.rms() == b[i].second->distance.rms());
    CHECK(a[i].second->distance.hausdorff() == b[i].second->distance.hausdorff());
  }
  CHECK(one.compactness.patch == four.compactness.patch);
}

}  // namespace intarsia
