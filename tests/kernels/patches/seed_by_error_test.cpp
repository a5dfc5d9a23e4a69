#include "kernels/patches/seed_by_error.h"

#include <algorithm>
#include <numbers>

#include <doctest/doctest.h>

#include "kernels/patches/even_cells.h"
#include "kernels/patches/flood_patches.h"
#include "tests/kernels/patches/patch_checks.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

// A flat square beside half a tube of the same width; they meet in a crease.
Soup flat_and_round() {
  return grid(40, 12, false, false, Diagonals::regular, [](Real u, Real v) {
    if (u < 0.5) return Vec3(-1 + 2 * u, v, 0);
    const Real a = std::numbers::pi * (2 * u - 1);
    return Vec3(0.5 - 0.5 * std::cos(a), v, 0.5 * std::sin(a));
  });
}

}  // namespace

TEST_CASE("the border of a flat square rebuilds it, that of half a tube does not") {
  const TestRefinement t = sharp_refinement(flat_and_round(), 1.0);
  const PatchSurface s = surface_of(t);
  const PatchLabels labels = flood_patches(Work(), s.mesh, t.refined.on_network);
  REQUIRE(labels.count == 2);
  const Csr faces = faces_of_patches(labels);
  const Regions regions(labels);
  RegionErrorScratch scratch;
  std::array<Real, 2> error{};
  for (Index p = 0; p < 2; ++p) error[p] = region_error(s, {p, 0, faces.row(p)}, regions, {}, scratch);
  CHECK(std::min(error[0], error[1]) < 1e-20);
  // Two half circles apart span the tube as a flat strip across: at most its radius off, on average much of it.
  CHECK(std::max(error[0], error[1]) > 1e-3);
}

TEST_CASE("seeds go where the error is: the flat patch stays whole") {
  const TestRefinement t = sharp_refinement(flat_and_round(), 1.0);
  const PatchSurface s = surface_of(t);
  const PatchLabels labels = flood_patches(Work(), s.mesh, t.refined.on_network);
  const auto run = [&](int threads) {
    return run_with_threads(threads, [&] { return seed_by_error(Work(), s, labels, 7, {}); });
  };
  const PatchLabels seeded = run(1);
  CHECK(seeded.count == 7);
  CHECK(run(3) == seeded);
  Index flat = kNone;
  for (Index f = 0; f < s.mesh.face_count(); ++f) {
    if (s.centroid(f).x() > 0) continue;
    if (flat == kNone) flat = seeded.patch_of_face[f];
    CHECK(seeded.patch_of_face[f] == flat);
  }
}

TEST_CASE("one patch becomes hundreds: all connected, all inside what they came from, the same on any threads") {
  const TestRefinement t = sharp_refinement(cube(24), 1.0);
  const PatchSurface s = surface_of(t);
  const PatchLabels labels = flood_patches(Work(), s.mesh, t.refined.on_network);
  const TestRefinement round = sharp_refinement(icosphere(4), 1.0);
  const PatchSurface ball = surface_of(round);
  const PatchLabels one = flood_patches(Work(), ball.mesh, round.refined.on_network);
  REQUIRE(one.count == 1);
  const auto run = [](const PatchSurface& surface, const PatchLabels& start, Index wanted, int threads) {
    return run_with_threads(threads, [&] { return seed_by_error(Work(), surface, start, wanted, {}); });
  };
  const PatchLabels seeded = run(ball, one, 300, 1);
  CHECK(seeded.count == 300);
  CHECK(flood_equal(Work(), ball.mesh, seeded.patch_of_face).count == 300);
  CHECK(run(ball, one, 300, 3) == seeded);
  // The error of a cap of a sphere falls with its size: seeds spread, none is left large, none is a crumb.
  std::vector<Real> area(300, 0);
  for (Index f = 0; f < ball.mesh.face_count(); ++f) area[seeded.patch_of_face[f]] += ball.area[f];
  CHECK(*std::max_element(area.begin(), area.end()) < 5 * ball.total_area / 300);
  const PatchLabels flat = run(s, labels, 100, 2);
  std::vector<Index> side(flat.count, kNone);
  for (Index f = 0; f < s.mesh.face_count(); ++f) {
    Index& of = side[flat.patch_of_face[f]];
    if (of == kNone) of = labels.patch_of_face[f];
    CHECK(of == labels.patch_of_face[f]);
  }
}

TEST_CASE("even cells lie inside patches, are connected, and of about even size") {
  const TestRefinement t = sharp_refinement(cube(12), 1.0);
  const PatchSurface s = surface_of(t);
  const PatchLabels labels = flood_patches(Work(), s.mesh, t.refined.on_network);
  EvenCellOptions options;
  options.per_patch = 10;
  const EvenCells even = cut_even_cells(Work(), s, labels, options);
  CHECK(even.cells.count == 60);
  CHECK(flood_equal(Work(), s.mesh, even.cells.patch_of_face).count == 60);
  std::vector<Real> area(60, 0);
  for (Index f = 0; f < s.mesh.face_count(); ++f) {
    CHECK(even.patch_of_cell[even.cells.patch_of_face[f]] == labels.patch_of_face[f]);
    area[even.cells.patch_of_face[f]] += s.area[f];
  }
  for (const Real a : area) {
    CHECK(a > 0.02);
    CHECK(a < 0.3);
  }
}

TEST_CASE("no seed is spent on a dent of one vertex, however far its normals are from all others") {
  Soup soup = grid(60, 60, false, false, Diagonals::regular, [](Real u, Real v) {
    const Real a = 2 * (u - 0.5);
    return Vec3(std::sin(a), v, std::cos(a));
  });
  for (const std::size_t dent : {1850u, 1220u, 2480u}) {
    soup.x[dent] *= 1.05, soup.z[dent] *= 1.05;
  }
  const TestRefinement t = sharp_refinement(soup, 4.0);
  const PatchSurface s = surface_of(t);
  const PatchLabels labels = flood_patches(Work(), s.mesh, t.refined.on_network);
  REQUIRE(labels.count == 1);
  const PatchLabels seeded = seed_by_error(Work(), s, labels, 12, {});
  CHECK(seeded.count == 12);
  std::vector<Real> area(seeded.count, 0);
  Real total = 0;
  for (Index f = 0; f < s.mesh.face_count(); ++f) area[seeded.patch_of_face[f]] += s.area[f], total += s.area[f];
  for (const Real a : area) CHECK(a > 0.005 * total);
}
