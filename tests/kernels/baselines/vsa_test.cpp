#include "kernels/baselines/vsa.h"

#include <algorithm>
#include <numbers>

#include <doctest/doctest.h>

#include "kernels/baselines/normal_regions.h"
#include "tests/support/baseline_checks.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;

namespace {

VsaFit fit(const Soup& soup, Index k) { return fit_planes(Work(), test::face_graph(soup), {.patches = k}); }

Soup two_half_planes(Real turn) {
  return test::grid(20, 10, false, false, test::Diagonals::regular, [&](Real u, Real v) {
    const Real x = 2 * u - 1;
    return x <= 0 ? Vec3(x, v, 0) : Vec3(x * std::cos(turn), v, -x * std::sin(turn));
  });
}

}  // namespace

TEST_CASE("a cube is six planes without any error, its sides") {
  const Soup soup = test::cube(5);
  const FaceGraph g = test::face_graph(soup);
  const VsaFit f = fit_planes(Work(), g, {.patches = 6});
  CHECK(f.count == 6);
  CHECK(f.energy == doctest::Approx(0).epsilon(1e-12));
  for (Index a = 0; a < g.faces(); ++a)
    for (Index b = 0; b < g.faces(); ++b) REQUIRE((f.region[a] == f.region[b]) == (g.normal[a].dot(g.normal[b]) > 0.5));
}

TEST_CASE("a plane has no error however it is divided; regions there are compact") {
  const FaceGraph g = test::face_graph(test::plane(30, 30));
  const VsaFit f = fit_planes(Work(), g, {.patches = 9});
  CHECK(f.count == 9);
  CHECK(f.energy == doctest::Approx(0).epsilon(1e-12));
  CHECK(test::pieces_equal_regions(g, f.region, 9));
  NormalRegions r;
  r.region = f.region;
  refit(g, r, 9);
  CHECK(*std::min_element(r.area.begin(), r.area.end()) > 0.02);
}

TEST_CASE("energy of one region: two half planes, a closed surface, a hemisphere") {
  for (const Real turn : {0.3, 1.0, 2.0}) {
    const VsaFit f = fit(two_half_planes(turn), 1);
    CHECK(f.energy == doctest::Approx(2 * 2 * (1 - std::cos(turn / 2))).epsilon(1e-9));
  }
  const FaceGraph sphere = test::face_graph(test::icosphere(4));
  Real area = 0;
  for (const Real a : sphere.area) area += a;
  CHECK(fit(test::icosphere(4), 1).energy == doctest::Approx(2 * area).epsilon(1e-9));
  std::vector<Index> upper(sphere.faces());
  for (Index i = 0; i < sphere.faces(); ++i) upper[i] = sphere.centroid[i].z() > 0 ? 0 : 1;
  CHECK(normal_energy(sphere, upper, 2) == doctest::Approx(4 * std::numbers::pi).epsilon(0.02));
}

TEST_CASE("a sphere: no worse than its six cube sides and its eight octants") {
  CHECK(fit(test::icosphere(4), 6).energy < 4.2366 * 1.002);
  const VsaFit eight = fit(test::icosphere(4), 8);
  CHECK(eight.energy < 3.3622 * 1.002);
  CHECK(eight.count == 8);
  CHECK(test::pieces_equal_regions(test::face_graph(test::icosphere(4)), eight.region, 8));
}

TEST_CASE("an ellipsoid: energies of the queue with exact order, within two per cent") {
  const Soup soup = test::ellipsoid(4, 1, 1.5, 2);
  Real last = 1e9;
  for (const Index k : {6u, 12u, 20u}) {
    const VsaFit f = fit(soup, k);
    CHECK(f.count == k);
    CHECK(f.energy < last);
    CHECK(f.energy == doctest::Approx(normal_energy(test::face_graph(soup), f.region, k)));
    CHECK(*std::min_element(f.history.begin(), f.history.end()) == f.energy);
    last = f.energy;
  }
}

TEST_CASE("pieces: each its own regions; more pieces than patches stay as they are") {
  const Soup two = test::side_by_side(test::icosphere(2), test::cube(3));
  const FaceGraph g = test::face_graph(two);
  for (const Index k : {1u, 2u, 7u, 14u}) {
    CAPTURE(k);
    const VsaFit f = fit_planes(Work(), g, {.patches = k});
    CHECK(f.count == std::max(k, 2u));
    CHECK(test::pieces_equal_regions(g, f.region, f.count));
  }
  const VsaFit most = fit(test::cube(1), 500);
  CHECK(most.count == 12);
}

TEST_CASE("teleporting moves regions to where they are needed and never loses") {
  // A sphere beside a plane that has got all regions but one.
  const FaceGraph g = test::face_graph(test::side_by_side(test::icosphere(3), test::plane(24, 24)));
  NormalRegions r;
  r.region.resize(g.faces());
  for (Index f = 0; f < g.faces(); ++f) r.region[f] = f < 1280 ? 0 : 1 + static_cast<Index>(g.centroid[f].y() * 3.999);
  refit(g, r, 5);
  FaceQueue queue;
  for (int i = 0; i < 3; ++i) {
    const Real before = r.total();
    REQUIRE(teleport(Work(), g, r, queue) > 0);
    CHECK(r.total() < before);
    CHECK(test::pieces_equal_regions(g, r.region, 5));
  }
  CHECK(teleport(Work(), g, r, queue) == 0);
}

TEST_CASE("the labels do not depend on threads") {
  const FaceGraph g = test::face_graph(test::jittered(test::torus(1, 0.4, 60, 30), 0.02, 5));
  const auto run = [&](int threads) {
    return test::run_with_threads(threads, [&] { return fit_planes(Work(), g, {.patches = 17}); });
  };
  const VsaFit one = run(1);
  CHECK(one.count == 17);
  for (const int threads : {2, 5}) {
    const VsaFit f = run(threads);
    CHECK(f.region == one.region);
    CHECK(f.energy == one.energy);
  }
}

TEST_CASE("balls of faces first: the same energies within two per cent") {
  const Soup soup = test::jittered(test::icosphere(5), 0.001, 3);
  const FaceGraph g = test::face_graph(soup);
  const BallGraph balls = gather_balls(Work(), g, 8);
  CHECK(balls.graph.faces() < g.faces() / 4);
  CHECK(connected_pieces(g, balls.ball).count == balls.graph.faces());
  VsaOptions options;
  options.patches = 8;
  const VsaFit all = fit_planes(Work(), g, options);
  options.coarse_faces = 2000;
  const VsaFit coarse = fit_planes(Work(), g, options);
  CHECK(coarse.count == 8);
  CHECK(coarse.energy < all.energy * 1.02);
  CHECK(coarse.energy == doctest::Approx(normal_energy(g, coarse.region, 8)));
  CHECK(test::pieces_equal_regions(g, coarse.region, 8));
  const NormalRegions of_balls = [&] {
    NormalRegions r;
    r.region.assign(balls.graph.faces(), 0);
    refit(balls.graph, r, 1);
    return r;
  }();
  CHECK(of_balls.total() == doctest::Approx(normal_energy(g, std::vector<Index>(g.faces(), 0), 1)));
}
