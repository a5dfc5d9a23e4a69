// Shapes whose layout anyone can tell beforehand.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "tests/support/layout_run.h"
#include "tests/support/shapes.h"
#include "tools/make/shape.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

Soup made(const char* shape, std::uint64_t triangles, Real noise_edges = 0) {
  tools::MakeOptions o;
  o.shape = shape, o.triangles = triangles, o.noise_edges = noise_edges;
  return tools::make_shape(Work(), o);
}

Real feature_length(const graph::Layout& layout) {
  return length_of(layout, CurveKind::ridge) + length_of(layout, CurveKind::valley) +
         length_of(layout, CurveKind::sharp);
}

void check_valid(const LayoutRun& run) {
  for (const auto& c : run.layout->checks.checks) {
    CAPTURE(c.name);
    CHECK(c.passed());
  }
}

}  // namespace

TEST_CASE("sphere, plane, torus and a noisy sphere have no features and still get a layout of discs") {
  const std::pair<const char*, Real> cases[] = {{"sphere", 0}, {"plane", 0}, {"torus", 0}, {"sphere", 0.1}};
  for (const auto& known : cases) {
    const char* shape = known.first;
    const Real noise = known.second;
    CAPTURE(shape);
    CAPTURE(noise);
    const LayoutRun run = run_layout(made(shape, 20'000, noise), graph::robust_options());
    CHECK(run.network->features.curve_count() == 0);
    CHECK(feature_length(*run.layout) == 0);
    check_valid(run);
  }
}

TEST_CASE("the ellipsoid 3:2:1 has one closed ridge of length 15.865") {
  const LayoutRun run = run_layout(made("ellipsoid", 20'000), graph::robust_options());
  REQUIRE(run.network->features.curve_count() == 1);
  CHECK(run.network->features.is_closed(0));
  CHECK(run.network->ends == 0);
  const Real length = length_of(*run.layout, CurveKind::ridge) * run.surface->box.diagonal;
  CHECK(length == doctest::Approx(15.865).epsilon(0.005));
  check_valid(run);
}

TEST_CASE("a cube has its 12 edges, 8 corners and 6 faces") {
  const LayoutRun run = run_layout(made("cube", 6'000), graph::robust_options());
  check_valid(run);
  CHECK(run.layout->labels.count == 6);
  CHECK(run.layout->graph.arc_count() == 12);
  CHECK(run.layout->graph.node_count() == 8);
  for (Index a = 0; a < run.layout->graph.arc_count(); ++a) CHECK(run.layout->graph.kind[a] == CurveKind::sharp);
  CHECK(feature_length(*run.layout) * run.surface->box.diagonal == doctest::Approx(24).epsilon(1e-9));
}

TEST_CASE("a cube with fillets of 2, 4 and 8 edges: 6 faces, 8 corners, 12 edges that are mostly ridges") {
  for (const Real edges : {2.0, 4.0, 8.0}) {
    CAPTURE(edges);
    const Real h = 0.25 / edges;  // the default fillet is 0.25 on a half side of 1
    const LayoutRun run =
        run_layout(made("rounded-box", static_cast<std::uint64_t>(22 / (0.433 * h * h))), graph::robust_options());
    check_valid(run);
    const graph::Layout& layout = *run.layout;
    CHECK(layout.labels.count == 6);
    for (Index p = 0; p < layout.labels.count; ++p)
      CHECK(layout.table.area[p] == doctest::Approx(run.surface->area / 6).epsilon(0.05));
    std::vector<Index> degree(layout.graph.node_count(), 0);
    for (Index a = 0; a < layout.graph.arc_count(); ++a) ++degree[layout.graph.start[a]], ++degree[layout.graph.end[a]];
    const auto corners = std::count(degree.begin(), degree.end(), 3u);
    const auto through = std::count(degree.begin(), degree.end(), 2u);
    CHECK(corners == 8);
    CHECK(corners + through == layout.graph.node_count());
    CHECK(layout.graph.arc_count() - through == 12);
    Real total = 0;
    for (Real l : layout.graph.length) total += l;
    CHECK(length_of(layout, CurveKind::ridge) > 0.6 * total);
  }
}

TEST_CASE("the number of patches that is asked for comes out exactly") {
  for (const char* shape : {"part", "star", "sphere", "half-pipe"})
    for (const Index wanted : {8u, 20u, 60u}) {
      CAPTURE(shape);
      CAPTURE(wanted);
      graph::LayoutOptions options = graph::robust_options();
      options.patches = wanted;
      const LayoutRun run = run_layout(made(shape, 12'000), options);
      CHECK(run.layout->labels.count == wanted);
      check_valid(run);
    }
}

TEST_CASE("more patches than triangles, or fewer than pieces: the nearest possible number and a warning") {
  graph::LayoutOptions options = graph::robust_options();
  options.patches = 1000;
  LayoutRun run = run_layout(icosphere(1), options);
  CHECK(run.layout->labels.count <= 80);
  CHECK(std::any_of(run.warnings.begin(), run.warnings.end(), [](const Warning& w) { return w.code == "patches"; }));
  options.patches = 1;
  run = run_layout(
      joined(icosphere(3), transformed(icosphere(3), [](const Vec3& p) { return Vec3(p + Vec3(4, 0, 0)); })), options);
  CHECK(run.layout->labels.count >= 2);
  CHECK(std::any_of(run.warnings.begin(), run.warnings.end(), [](const Warning& w) { return w.code == "patches"; }));
  CHECK(run.layout->checks.is_valid());
}
