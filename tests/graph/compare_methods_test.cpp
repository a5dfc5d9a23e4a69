#include "graph/compare_methods.h"

#include <set>

#include <doctest/doctest.h>

#include "tests/support/rounded_cube.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::graph;

namespace {

// A ball with three bulges and hollows on its equator, more of them towards one side: nothing is alike on both sides.
Soup bulged_ball(int level) {
  return test::transformed(test::icosphere(level), [](const Vec3& p) -> Vec3 {
    const Real wave = std::cos(3 * std::atan2(p.y(), p.x())) * (1 - p.z() * p.z()) * (1 + 0.5 * p.x());
    return (1 + 0.25 * wave) * p;
  });
}

Layout layout_on(int threads, const Soup& soup, Method method, const LayoutOptions& options) {
  return test::run_with_threads(threads,
                                [&] { return layout_by(Work(), prepare(Work(), soup, options), method, options); });
}

void check_labels(const Layout& layout, const Mesh& surface) {
  CHECK(layout.checks.is_valid());
  CHECK(layout.labels.patch_of_face.size() == layout.refined.mesh.face_count());
  CHECK(layout.face_patch.size() == surface.face_count());
  std::set<Index> used;
  for (const Index p : layout.labels.patch_of_face) {
    REQUIRE(p < layout.labels.count);
    used.insert(p);
  }
  CHECK(used.size() == layout.labels.count);
  for (const Index p : layout.face_patch) REQUIRE(p < layout.labels.count);
}

}  // namespace

TEST_CASE("methods have names and flags of their own") {
  std::set<std::string> names, flags;
  for (const Method m : all_methods()) {
    CHECK(names.insert(name_of(m)).second);
    CHECK(flags.insert(short_name_of(m)).second);
    CHECK(short_name_of(m).find(' ') == std::string::npos);
    CHECK(is_ours(m) == (name_of(m).rfind("ours", 0) == 0));
  }
  CHECK(names.size() == 10);
}

TEST_CASE("every method gives the wanted number of patches, labels every face, and does not see the threads") {
  LayoutOptions options = robust_options();
  options.patches = 9;
  options.refine.rounds = 1, options.refine.swap.sweeps = 2, options.refine.even.per_patch = 5;  // quick
  const Soup soup = bulged_ball(3);
  const Prepared prepared = prepare(Work(), soup, options);
  for (const Method m : all_methods()) {
    CAPTURE(name_of(m));
    const Layout one = layout_on(1, soup, m, options);
    CHECK(one.labels.count == 9);
    check_labels(one, prepared.surface.mesh);
    if (is_ours(m))
      for (Index p = 0; p < one.table.count(); ++p) CHECK(one.table.is_disc(p));
    CHECK(hash_of(one) == hash_of(layout_on(3, soup, m, options)));
  }
}

TEST_CASE("the features of a rounded cube are in our layouts and not in the others") {
  LayoutOptions options = robust_options();
  options.patches = 12;
  options.refine.rounds = 0, options.refine.swap.sweeps = 1;
  const Soup soup = test::RoundedCube{5, 2}.mesh(0, 1);
  const Prepared prepared = prepare(Work(), soup, options);
  for (const Method m : {Method::faithful, Method::compact, Method::vsa}) {
    CAPTURE(name_of(m));
    const Layout layout = layout_by(Work(), prepared, m, options);
    CHECK(layout.labels.count == 12);
    Real features = 0;
    for (Index a = 0; a < layout.graph.arc_count(); ++a)
      if (layout.graph.kind[a] == CurveKind::ridge) features += layout.graph.length[a];
    CHECK((features > 0) == is_ours(m));
  }
}
