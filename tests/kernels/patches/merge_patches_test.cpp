#include "kernels/patches/merge_patches.h"

#include "engine/base/random.h"
#include "kernels/patches/flood_patches.h"
#include "kernels/patches/measure_patches.h"
#include "tests/kernels/patches/patch_checks.h"

using namespace intarsia;
using namespace intarsia::kernels;

namespace {
// Cuts along grid lines x = const of a surface over the unit square.
template <class OnCut>
test::TestRefinement cut_along_x(const Soup& soup, const OnCut& on_cut) {
  return test::identity_refinement(soup, [&](const MeshView& m, Index e) {
    const Vec3 a = m.point(m.edge_v0[e]), b = m.point(m.edge_v1[e]);
    return std::abs(a.x() - b.x()) < 1e-9 && on_cut(a.x());
  });
}
bool near(Real a, Real b) { return std::abs(a - b) < 1e-9; }
}  // namespace

TEST_CASE("random merges: the graph knows the union without looking at faces") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Random random(seed, 5);
    Soup soup = seed % 2 ? test::icosphere(3) : test::torus(1, 0.4, 24, 12);
    if (seed % 3 == 0) {  // holes: every tenth face or so
      Soup open = soup;
      open.corner.clear();
      for (Index f = 0; f < soup.face_count(); ++f)
        if (random.uniform(f, 9) > 0.08)
          open.corner.insert(open.corner.end(), soup.corner.begin() + 3 * f, soup.corner.begin() + 3 * f + 3);
      soup = open;
    }
    const auto t = test::identity_refinement(soup, [&](const MeshView&, Index e) { return random.uniform(e) < 0.6; });
    const auto s = test::surface_of(t, 1.0);
    const auto labels = flood_patches(Work(), s.mesh, t.refined.on_network);
    PatchGraph graph(Work(), s, labels);
    for (std::uint64_t step = 0; graph.alive() > 1; ++step) {
      std::vector<std::pair<Index, Border>> choices;
      for (Index p = 0; p < graph.size(); ++p)
        for (const Border& b : graph[p].borders)
          if (b.edges > 0 && p < b.other) choices.push_back({p, b});
      if (choices.empty()) break;
      const auto [p, border] = choices[random.bits(step, 3) % choices.size()];
      const int euler = graph.union_euler(p, border);
      const Index kept = graph.merge(p, border.other);
      CHECK(graph[kept].euler == euler);
      if (step % 7 && graph.alive() > 3) continue;
      const auto now = graph.labels(Work(), labels);
      const auto table = measure_patches(Work(), s, now);
      REQUIRE(now.count == graph.alive());
      for (Index q = 0; q < graph.size(); ++q) {
        if (!graph[q].alive) continue;
        const Index label = now.patch_of_face[graph[q].first_face];
        CHECK(graph[q].euler == table.euler[label]);
        CHECK(graph[q].area == doctest::Approx(table.area[label]));
        CHECK(graph[q].perimeter == doctest::Approx(table.perimeter[label]));
        CHECK((graph[q].normal_sum - table.normal_sum[label]).norm() < 1e-12);
      }
    }
  }
}

TEST_CASE("a thin strip merges, wide neighbours stay, and the count agrees") {
  const auto t = cut_along_x(test::plane(40, 40), [](Real x) { return near(x, 0.5) || near(x, 0.525); });
  const auto s = test::surface_of(t);
  const auto labels = flood_patches(Work(), s.mesh, t.refined.on_network);
  REQUIRE(labels.count == 3);
  const auto merged = merge_patches(Work(), s, labels, {});
  CHECK(merged.count == 2);
  CHECK(count_after_merge(Work(), s, t.refined.on_network, {}) == 2);
  CHECK(test::is_connected(s.mesh, merged));
}

TEST_CASE("a strip is a face of its own between two folds, however narrow, and merges between two slight ones") {
  // A ridge's flat top, 0.025 wide with triangles of that size: its sides fall away by `slope`.
  const auto count = [](Real slope) {
    const auto soup = test::height_field(
        40, 40, 0, 1, 0, 1, [&](Real x, Real) { return -slope * std::max(Real{0}, std::abs(x - 0.5125) - 0.0125); });
    const auto t = cut_along_x(soup, [](Real x) { return near(x, 0.5) || near(x, 0.525); });
    const auto s = test::surface_of(t);
    return merge_patches(Work(), s, flood_patches(Work(), s.mesh, t.refined.on_network), {}).count;
  };
  CHECK(count(std::tan(1.2)) == 3);
  CHECK(count(std::tan(0.8)) == 2);
}

TEST_CASE("the sharp border stays when another neighbour will do") {
  // A sliver between a fold of 60 degrees at x = 0.5 and a drawn line at x = 0.525 in the same plane.
  for (const bool mirrored : {false, true}) {
    const auto soup = test::height_field(40, 40, 0, 1, 0, 1, [&](Real x, Real) {
      const Real d = mirrored ? 0.5 - x : x - 0.5;
      return d > 0 ? std::sqrt(3.0) * d : 0;
    });
    const Real line = mirrored ? 0.475 : 0.525;
    const auto t = cut_along_x(soup, [&](Real x) { return near(x, 0.5) || near(x, line); });
    const auto s = test::surface_of(t);
    const auto merged =
        merge_patches(Work(), s, flood_patches(Work(), s.mesh, t.refined.on_network), {.widest_tiny = 0.1});
    REQUIRE(merged.count == 2);
    const auto table = measure_patches(Work(), s, merged);
    for (Index p = 0; p < 2; ++p) CHECK(table.normal_sum[p].norm() == doctest::Approx(table.area[p]));
  }
}

TEST_CASE("a tiny component stays") {
  const auto t =
      test::identity_refinement(test::joined(test::plane(20, 20), test::scaled(test::cube(1), 1e-3)), test::nowhere);
  const auto s = test::surface_of(t);
  CHECK(count_after_merge(Work(), s, t.refined.on_network, {}) == 2);
}

TEST_CASE("merging the cheapest pairs: the eight octants of a cube's subdivision come back to six sides") {
  // Every side of a cube cut in two: taking down the cuts in the sides costs nothing, the cube's edges cost most.
  const auto t = test::identity_refinement(test::cube(8), [](const MeshView& m, Index e) {
    if (test::turn(m, e) > 0.5) return true;
    const Vec3 a = m.point(m.edge_v0[e]), b = m.point(m.edge_v1[e]);
    for (int axis = 0; axis < 3; ++axis) {  // the cut of the sides whose normal is the next axis
      const int normal = (axis + 1) % 3;
      if (near(a[axis], 0.5) && near(b[axis], 0.5) && near(a[normal], b[normal]) &&
          (near(a[normal], 0) || near(a[normal], 1)))
        return true;
    }
    return false;
  });
  const auto s = test::surface_of(t);
  const auto labels = flood_patches(Work(), s.mesh, t.refined.on_network);
  REQUIRE(labels.count == 12);
  PatchGraph graph(Work(), s, labels);
  merge_cheapest(
      Work(), {}, 6, [](Index, const Border&) { return true; }, graph);
  const auto table = measure_patches(Work(), s, graph.labels(Work(), labels));
  REQUIRE(table.count() == 6);
  for (Index p = 0; p < 6; ++p) CHECK(table.normal_sum[p].norm() == doctest::Approx(1));
}
