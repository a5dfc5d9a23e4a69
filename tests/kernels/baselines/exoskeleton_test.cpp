#include "kernels/baselines/exoskeleton.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include <doctest/doctest.h>

#include "kernels/baselines/part_segmentation.h"
#include "kernels/baselines/shape_diameter.h"
#include "tests/support/baseline_checks.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;

namespace {

// A body of revolution around z: a thin rod with a ball on each end.
Soup dumb_bell() {
  return test::transformed(test::icosphere(5), [](const Vec3& p) {
    const Real z = 2 * p.z(), out = std::hypot(p.x(), p.y());
    const Real near = std::abs(z) - 1.4;  // centre of a ball
    const Real ball = 0.36 - near * near;
    const Real r = std::max(ball > 0 ? std::sqrt(ball) : 0.0, std::abs(z) < 1.4 ? 0.12 : 0.0);
    return out > 0 ? Vec3(p.x() / out * r, p.y() / out * r, z) : Vec3(0, 0, z);
  });
}

}  // namespace

TEST_CASE("diameter of a sphere: a little less than twice its radius, the same everywhere") {
  const Soup soup = test::icosphere(4);
  const Mesh mesh = test::raw_mesh(soup);
  const std::vector<Real> d = shape_diameter(Work(), mesh, test::face_graph(soup), {});
  for (const Real x : d) {  // chords at up to 60 degrees, within a deviation of the median
    CHECK(x > 1.3);
    CHECK(x < 2.0);
    CHECK(x == doctest::Approx(d[0]).epsilon(0.01));
  }
}

TEST_CASE("an open plane has no diameter") {
  const Soup soup = test::plane(10, 10);
  const std::vector<Real> d = shape_diameter(Work(), test::raw_mesh(soup), test::face_graph(soup), {});
  for (const Real x : d) CHECK(x == 0);
}

TEST_CASE("a mixture finds two bells") {
  std::vector<Real> value, weight;
  for (int i = 0; i < 400; ++i) {
    const Real t = (i + 0.5) / 400 * 2 - 1;
    value.push_back(0.2 + 0.05 * t), value.push_back(0.8 + 0.1 * t);
    weight.push_back(1), weight.push_back(3);
  }
  const Mixture m = fit_mixture(value, weight, 2);
  CHECK(m.mean[0] == doctest::Approx(0.2).epsilon(0.02));
  CHECK(m.mean[1] == doctest::Approx(0.8).epsilon(0.02));
  CHECK(m.share[1] == doctest::Approx(0.75).epsilon(0.02));
  const Mixture flat = fit_mixture(std::vector<Real>(10, 1.0), std::vector<Real>(10, 1.0), 5);
  CHECK(std::isfinite(flat.density(0, 1.0)));
}

TEST_CASE("a dumb-bell has a rod and two balls") {
  const Soup soup = dumb_bell();
  const Mesh mesh = test::raw_mesh(soup);
  const FaceGraph g = test::face_graph(soup);
  PartOptions options;
  options.most = 3, options.least_area = 0.05;
  const PatchLabels parts = segment_parts(Work(), mesh, g, shape_diameter(Work(), mesh, g, DiameterOptions{}), options);
  REQUIRE(parts.count == 3);
  Real right = 0, area = 0;
  Index of[3] = {kNone, kNone, kNone};  // bottom, rod, top
  for (Index f = 0; f < g.faces(); ++f) {
    const Real z = g.centroid[f].z();
    if (std::abs(z + 1.4) < 0.05) of[0] = parts.patch_of_face[f];
    if (std::abs(z) < 0.05) of[1] = parts.patch_of_face[f];
    if (std::abs(z - 1.4) < 0.05) of[2] = parts.patch_of_face[f];
  }
  for (Index f = 0; f < g.faces(); ++f) {
    const Real z = g.centroid[f].z();
    const int where = z < -0.82 ? 0 : z > 0.82 ? 2 : 1;
    area += g.area[f];
    if (parts.patch_of_face[f] == of[where]) right += g.area[f];
  }
  CHECK(right > 0.95 * area);
}

TEST_CASE("patches are shared out by sqrt(E A), one at least") {
  const FaceGraph g = test::face_graph(test::side_by_side(test::icosphere(3), test::plane(10, 10)));
  const PatchLabels parts = connected_pieces(g);
  REQUIRE(parts.count == 2);
  CHECK(share_patches(g, parts, 1) == std::vector<Index>{1, 1});
  CHECK(share_patches(g, parts, 9) == std::vector<Index>{8, 1});
}

TEST_CASE("regions keep to their parts; as many as asked for, whatever the threads") {
  const Soup soup = dumb_bell();
  const FaceGraph g = test::face_graph(soup);
  std::vector<Index> by_height(g.faces());
  for (Index f = 0; f < g.faces(); ++f) by_height[f] = g.centroid[f].z() < -0.8 ? 7 : g.centroid[f].z() > 0.8 ? 3 : 5;
  const PatchLabels parts = connected_pieces(g, by_height);
  const auto run = [&](int threads) {
    return test::run_with_threads(threads, [&] { return fit_parts(Work(), g, parts, 14); });
  };
  const PatchLabels one = run(1);
  CHECK(one.count == 14);
  CHECK(test::pieces_equal_regions(g, one.patch_of_face, 14));
  std::vector<Index> part_of(14, kNone);
  for (Index f = 0; f < g.faces(); ++f) {
    Index& p = part_of[one.patch_of_face[f]];
    if (p == kNone) p = parts.patch_of_face[f];
    REQUIRE(p == parts.patch_of_face[f]);
  }
  CHECK(run(3) == one);
}
