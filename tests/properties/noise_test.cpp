// Features of noisy parts whose features are known.
#include <doctest/doctest.h>

#include "tests/support/coverage.h"
#include "tests/support/layout_run.h"
#include "tools/make/shape.h"
#include "tools/make/truth.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

tools::MakeOptions sample(const char* shape, Index triangles, Real noise) {
  tools::MakeOptions o;
  o.shape = shape, o.triangles = triangles, o.noise_diagonal = noise;
  return o;
}

Segments truth_of(const tools::MakeOptions& options) {
  Segments out;
  for (const tools::TrueCurve& c : tools::true_features(options).curves) {
    for (std::size_t i = 1; i < c.point.size(); ++i) out.emplace_back(c.point[i - 1], c.point[i]);
    if (c.closed) out.emplace_back(c.point.back(), c.point.front());
  }
  return out;
}

}  // namespace

TEST_CASE("noise of 0.1 and 0.3 % of the diagonal hides no sharp edge of a cube and makes none") {
  for (const Real noise : {0.001, 0.003}) {
    CAPTURE(noise);
    const tools::MakeOptions options = sample("cube", 12'000, noise);
    const LayoutRun run = run_layout(tools::make_shape({}, options), graph::robust_options());
    CHECK(run.layout->checks.is_valid());
    const Segments arcs = feature_arcs(*run.surface, *run.layout), truth = truth_of(options);
    const Real near = 0.01 * run.surface->box.diagonal;
    CHECK(covered(truth, arcs, near) > 0.95);
    CHECK(covered(arcs, truth, near) > 0.95);
    CHECK(run.layout->labels.count == 6);
  }
}

TEST_CASE("results of a noisy mesh keep the input's positions") {
  const tools::MakeOptions options = sample("cube", 3'000, 0.005);
  const Soup soup = tools::make_shape({}, options);
  const LayoutRun run = run_layout(soup, graph::robust_options());
  const graph::Surface& s = *run.surface;
  REQUIRE(s.given.size() == s.mesh.vertex_count());
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
    const Index i = s.order.vertex[v];
    CHECK((s.box.to_input(s.given[v]) - Vec3(soup.x[i], soup.y[i], soup.z[i])).norm() < 1e-12);
  }
}
