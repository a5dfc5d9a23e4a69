#include <doctest/doctest.h>

#include "graph/stages.h"
#include "tests/support/shapes.h"

using namespace intarsia;
using namespace intarsia::graph;

TEST_CASE("a fixed ring is the ring of every vertex, and nothing is fitted beyond it") {
  const Surface surface = mesh_to_surface(Work(), test::icosphere(3));
  LayoutOptions options = robust_options();
  for (const int ring : {1, 4, 6}) {
    options.fixed_ring = ring;
    const Sharp sharp = surface_to_sharp(Work(), surface, options);
    const Scale scale = surface_to_scale(Work(), surface, sharp, options);
    const std::vector<std::uint8_t> expected(surface.mesh.vertex_count(), static_cast<std::uint8_t>(ring));
    CHECK(scale.fields.scale == expected);
    CHECK(scale.fields.fit_ring == expected);
    const Curvature curvature = scale_to_curvature(Work(), surface, scale, sharp, options);
    // A sphere of diameter 1 / sqrt(3), the diagonal of its box being 1.
    for (const Real k : curvature.fields.kmax) CHECK(k == doctest::Approx(2 * std::sqrt(3.0)).epsilon(0.02));
  }
}
