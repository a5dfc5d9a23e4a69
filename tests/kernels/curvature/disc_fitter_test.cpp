#include "kernels/curvature/disc_fitter.h"

#include <cmath>

#include <doctest/doctest.h>

#include "kernels/scale/compute_scale.h"
#include "tests/support/surface.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

TEST_CASE("packs fit in discs what single vertices fit, each vertex once, in any mix of scales") {
  const TestSurface s = make_surface(jittered(ellipsoid(6, 3, 2, 1), 0.005, 5));
  const ScaleFields scale = compute_scale(Work{}, s.mesh, {});
  const SampleLevels& levels = scale.levels;
  REQUIRE_FALSE(levels.level.empty());
  std::vector<std::uint8_t> code(s.mesh.vertex_count());
  for (Index v = 0; v < s.mesh.vertex_count(); ++v)
    code[v] = static_cast<std::uint8_t>(v % 50 == 0 ? 3 : (v / 500) % 3 == 0 ? 16 : 14 + v % 3);
  const std::vector<Vec3Array> sample_normal = sample_normals(Work{}, s.mesh, levels, s.vertex_normal);
  const FitOptions options;
  DiscFitter together(s.mesh, levels, sample_normal);
  DiscWalker walker(levels);
  PointBatch batch;
  std::vector<std::uint8_t> met(s.mesh.vertex_count());
  Index packs = 0, lanes = 0;
  for (Index c = 0; c < levels.level[DiscFitter::start_level(levels)].size(); ++c)
    together.fit(c, s.vertex_normal, code, options, [&](const DiscFitter::Pack& pack) {
      ++packs;
      for (std::size_t l = 0; l < pack.size; ++l) {
        const Index v = pack.vertex[l];
        CAPTURE(v);
        ++met[v];
        ++lanes;
        CHECK(pack.code == code[v]);
        CHECK(levels.level[0].parent[v] == pack.cluster[l]);
        const VertexFit fit = fit_disc(s.mesh, levels, sample_normal, v, pack.cluster[l], code[v],
                                       Frame(s.vertex_normal[v]), options, walker, batch);
        REQUIRE((pack.fits.solved >> l & 1) == (fit.status == FitStatus::full));
        const Real r = fit.radius;
        CHECK(pack.fits.radius[l] == doctest::Approx(r).epsilon(1e-12));
        const CubicFit cubic = pack.fits.cubic(l);
        for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(cubic.b[i] - fit.cubic.b[i]) * r < 1e-9);
        for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(cubic.c[i] - fit.cubic.c[i]) * r * r < 1e-9);
      }
    });
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) CHECK(met[v] == is_disc(code[v]));
  CHECK(lanes > 3 * packs);
}
