#include "kernels/patches/flood_patches.h"

#include "engine/base/random.h"
#include "tests/kernels/patches/patch_checks.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;

TEST_CASE("a cube with its twelve edges has six patches, numbered by smallest face") {
  const auto t = test::sharp_refinement(test::cube(5), 0.5);
  const auto labels = flood_patches(Work(), t.refined.mesh, t.refined.on_network);
  CHECK(labels.count == 6);
  for (Index f = 0; f < 300; ++f) CHECK(labels.patch_of_face[f] == f / 50);
}

TEST_CASE("random networks: the labels are those of a sequential flood fill, for any number of threads") {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Random random(seed, 1);
    const Real share = 0.1 + 0.1 * static_cast<Real>(seed);
    const auto t = test::identity_refinement(test::shuffle(test::icosphere(4), seed),
                                             [&](const MeshView&, Index e) { return random.uniform(e) < share; });
    const MeshView m = t.refined.mesh.view();
    const auto expected = test::sequential_flood(m, [&](Index e) { return !t.refined.on_network[e]; });
    for (const int threads : {1, 2, 3, 8}) {
      const auto labels =
          test::run_with_threads(threads, [&] { return flood_patches(Work(), m, t.refined.on_network); });
      CHECK(labels == expected);
    }
  }
}

TEST_CASE("edges with one patch on both sides leave the network, boundary edges stay") {
  // A slit that ends inside a square, and a full cut.
  const auto t = test::identity_refinement(test::plane(6, 6), [](const MeshView& m, Index e) {
    const Vec3 a = m.point(m.edge_v0[e]), b = m.point(m.edge_v1[e]);
    const bool cut = a.x() == b.x() && std::abs(a.x() - 0.5) < 1e-9;
    const bool slit = a.y() == b.y() && std::abs(a.y() - 0.5) < 1e-9 && std::max(a.x(), b.x()) < 0.4;
    return cut || slit;
  });
  const MeshView m = t.refined.mesh.view();
  auto network = t.refined.on_network;
  const auto labels = flood_patches(Work(), m, network);
  CHECK(labels.count == 2);
  CHECK(clear_dangling(Work(), m, labels, network) == 2);
  std::size_t left = 0;
  for (const auto on : network) left += on;
  CHECK(left == 24 + 6);
  CHECK(flood_patches(Work(), m, network) == labels);
}

TEST_CASE("ids with gaps become ranks of smallest faces") {
  const std::vector<Index> id{7, 7, 2, 9, 2};
  const auto labels = compact_labels(Work(), id, 10);
  CHECK(labels.count == 3);
  CHECK(labels.patch_of_face == std::vector<Index>{0, 0, 1, 2, 1});
}
