// The same surface, sampled coarsely, finely and unevenly: the same layout.
#include <algorithm>

#include <doctest/doctest.h>

#include "kernels/surface/split_long_edges.h"
#include "tests/support/coverage.h"
#include "tests/support/layout_run.h"
#include "tests/support/shapes.h"
#include "tests/support/uneven.h"
#include "tools/make/shape.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

struct Found {
  Segments arcs;
  Real patches = 0, diagonal = 1;
};

Found found_on(const Soup& soup, graph::LayoutOptions options = graph::robust_options()) {
  const LayoutRun run = run_layout(soup, options);
  CHECK(run.layout->checks.is_valid());
  return {feature_arcs(*run.surface, *run.layout), static_cast<Real>(run.layout->labels.count),
          run.surface->box.diagonal};
}

}  // namespace

TEST_CASE("a star of 10 000 or 100 000 triangles, even or uneven, gets the same layout") {
  tools::MakeOptions o;
  o.shape = "star", o.triangles = 100'000;
  const Soup fine = tools::make_shape({}, o);
  o.triangles = 10'000;
  const Soup coarse = tools::make_shape({}, o);
  o.triangles = 30'000;
  const Soup even = tools::make_shape({}, o);
  const Soup mixed = halved_at_random(even, 0.5, 3, 1);
  const Soup graded = halved_where(even, 5, [&](Index t) { return even.x[even.corner[3 * std::size_t{t}]] > 0.6; });
  CHECK(kernels::edge_variation({}, fine) < 0.25);
  CHECK(kernels::edge_variation({}, mixed) > 0.4);
  CHECK(kernels::edge_variation({}, graded) > 0.6);
  const Found a = found_on(fine);
  for (const Soup* other : {&coarse, &mixed, &graded}) {
    CAPTURE(other->face_count());
    const Found b = found_on(*other);
    CHECK(b.patches == doctest::Approx(a.patches).epsilon(0.1));
    CHECK(length_of(b.arcs) == doctest::Approx(length_of(a.arcs)).epsilon(0.1));
    CHECK(covered(a.arcs, b.arcs, 0.01 * a.diagonal) > 0.75);  // the median is well below 1 %
    CHECK(covered(b.arcs, a.arcs, 0.01 * a.diagonal) > 0.75);
  }
}

TEST_CASE("a bar of twelve long triangles has six faces") {
  Real length = 0;
  SUBCASE("30 : 1 : 1") { length = 30; }
  SUBCASE("300 : 1 : 1, narrower than the steps in which features are looked for") { length = 300; }
  const Soup bar = transformed(cube(1), [length](const Vec3& p) { return Vec3(length * p.x(), p.y(), p.z()); });
  graph::LayoutOptions options = graph::robust_options();
  options.split_edges.uneven = 0.5;
  const LayoutRun run = run_layout(bar, options);
  CHECK(run.layout->checks.is_valid());
  CHECK(run.layout->labels.count == 6);
  CHECK(run.layout->graph.arc_count() == 12);
  std::vector<Index> parent(run.surface->order.face);
  std::sort(parent.begin(), parent.end());
  parent.erase(std::unique(parent.begin(), parent.end()), parent.end());
  CHECK(parent.size() == 12);
  // both triangles of each side have one label
  std::vector<Index> label(12, kNone);
  for (Index f = 0; f < run.surface->mesh.face_count(); ++f) {
    Index& l = label[run.surface->order.face[f]];
    CHECK((l == kNone || l == run.layout->face_patch[f]));
    l = run.layout->face_patch[f];
  }
}
