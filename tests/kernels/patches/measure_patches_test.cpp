#include "kernels/patches/measure_patches.h"

#include <functional>

#include "engine/base/random.h"
#include "kernels/patches/flood_patches.h"
#include "tests/kernels/patches/patch_checks.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;

namespace {
PatchLabels labels_of(const test::TestRefinement& t, const std::function<Index(const Vec3&)>& of_centroid) {
  const auto s = test::surface_of(t);
  PatchLabels labels;
  for (Index f = 0; f < s.mesh.face_count(); ++f) {
    labels.patch_of_face.push_back(of_centroid(s.centroid(f)));
    labels.count = std::max(labels.count, labels.patch_of_face.back() + 1);
  }
  return labels;
}
// A plane with its inner cell (i, j) of n x n left out.
Soup holed_plane(Index n, Index i, Index j) {
  Soup s = test::plane(n, n);
  const std::size_t at = 6 * std::size_t{j * n + i};
  s.corner.erase(s.corner.begin() + static_cast<std::ptrdiff_t>(at),
                 s.corner.begin() + static_cast<std::ptrdiff_t>(at) + 6);
  return s;
}
}  // namespace

TEST_CASE("the faces of a cube are unit squares and discs") {
  const auto t = test::sharp_refinement(test::cube(4), 0.5);
  const auto s = test::surface_of(t);
  const auto labels = flood_patches(Work(), s.mesh, t.refined.on_network);
  const auto table = measure_patches(Work(), s, labels);
  REQUIRE(table.count() == 6);
  for (Index p = 0; p < 6; ++p) {
    CHECK(table.area[p] == doctest::Approx(1).epsilon(1e-12));
    CHECK(table.normal_sum[p].norm() == doctest::Approx(1).epsilon(1e-12));
    CHECK(table.perimeter[p] == doctest::Approx(4).epsilon(1e-12));
    CHECK(table.faces[p] == 32);
    CHECK(table.euler[p] == 1);
    CHECK(table.loops[p] == 1);
    CHECK(table.is_disc(p));
  }
}

TEST_CASE("closed surfaces, annuli and discs are told apart") {
  const auto whole = [](const Soup& soup) {
    const auto t = test::identity_refinement(soup, test::nowhere);
    const auto s = test::surface_of(t);
    return measure_patches(Work(), s, flood_patches(Work(), s.mesh, t.refined.on_network));
  };
  const auto sphere = whole(test::icosphere(2));
  CHECK(sphere.euler[0] == 2);
  CHECK(sphere.loops[0] == 0);
  CHECK(sphere.normal_sum[0].norm() < 1e-12);
  CHECK(whole(test::torus(2, 0.7, 24, 12)).euler[0] == 0);
  const auto tube = whole(test::cylinder(1, 1, 2, 24, 8));
  CHECK(tube.euler[0] == 0);
  CHECK(tube.loops[0] == 2);
  CHECK(!tube.is_disc(0));
  CHECK(whole(test::plane(5, 5)).is_disc(0));
}

TEST_CASE("a patch that touches itself in a vertex is no disc") {
  // A ring of cells around one cell of a 3 x 3 grid, opened at a corner cell: the ring touches itself there.
  const auto t = test::identity_refinement(test::plane(3, 3), test::nowhere);
  const auto s = test::surface_of(t);
  const auto labels = labels_of(t, [](const Vec3& c) -> Index {
    const int i = static_cast<int>(c.x() * 3), j = static_cast<int>(c.y() * 3);
    return (i == 1 && j == 1) || (i == 2 && j == 2) ? 1 : 0;
  });
  const auto table = measure_patches(Work(), s, labels);
  CHECK(table.euler[0] == test::euler_by_sets(s.mesh, labels, 0));
  CHECK(table.euler[0] == 0);
  CHECK(table.loops[0] == 1);  // one closed walk that passes the vertex twice
  CHECK(!table.is_disc(0));
}

TEST_CASE("a short hole inside one patch counts as filled, a long one and a shared one do not") {
  const auto small = test::identity_refinement(holed_plane(100, 50, 50), test::nowhere);
  const auto s = test::surface_of(small);
  REQUIRE(s.hole.rows() == 1);
  auto table = measure_patches(Work(), s, flood_patches(Work(), s.mesh, small.refined.on_network));
  CHECK(table.filled_holes[0] == 1);
  CHECK(table.euler[0] == 1);
  CHECK(table.is_disc(0));
  const auto shared = labels_of(small, [](const Vec3& c) -> Index { return c.x() < 0.505 ? 0 : 1; });
  table = measure_patches(Work(), s, shared);
  CHECK(table.filled_holes[0] + table.filled_holes[1] == 0);
  CHECK(table.is_disc(0));
  CHECK(table.is_disc(1));
  const auto strict = test::surface_of(small, 0.03);
  table = measure_patches(Work(), strict, flood_patches(Work(), strict.mesh, small.refined.on_network));
  CHECK(table.loops[0] == 2);
  CHECK(!table.is_disc(0));
}

TEST_CASE("a patch border that runs through a vertex of a filled hole") {
  const auto t = test::identity_refinement(holed_plane(100, 50, 50), test::nowhere);
  const auto s = test::surface_of(t);
  const auto labels = labels_of(t, [](const Vec3& c) -> Index { return c.x() > 0.51 && c.y() > 0.51 ? 1 : 0; });
  const auto table = measure_patches(Work(), s, labels);
  CHECK(table.filled_holes[0] == 1);
  CHECK(table.is_disc(0));
  CHECK(table.is_disc(1));
}

TEST_CASE("the outer border of a crumb is no hole") {
  Soup crumb = test::scaled(test::plane(1, 1), 0.01);
  const auto t = test::identity_refinement(test::joined(test::plane(10, 10), crumb), test::nowhere);
  const auto s = test::surface_of(t);
  CHECK(s.hole.rows() == 0);
  const auto table = measure_patches(Work(), s, flood_patches(Work(), s.mesh, t.refined.on_network));
  CHECK(table.is_disc(0));
  CHECK(table.is_disc(1));
}

TEST_CASE("random labels: Euler characteristics equal those of sets, for any number of threads") {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const auto t = test::identity_refinement(
        test::torus(1, 0.4, 30, 14), [&](const MeshView&, Index e) { return Random(seed, 2).uniform(e) < 0.4; });
    const auto s = test::surface_of(t);
    const auto labels = flood_patches(Work(), s.mesh, t.refined.on_network);
    const auto table = measure_patches(Work(), s, labels);
    Real area = 0;
    for (Index p = 0; p < labels.count; ++p) {
      CHECK(table.euler[p] == test::euler_by_sets(s.mesh, labels, p));
      area += table.area[p];
    }
    CHECK(area == doctest::Approx(s.total_area).epsilon(1e-12));
    for (const int threads : {2, 3, 8}) {
      const auto again = test::run_with_threads(threads, [&] { return measure_patches(Work(), s, labels); });
      CHECK(again.euler == table.euler);
      CHECK(again.area == table.area);
      CHECK(again.loops == table.loops);
    }
  }
}
