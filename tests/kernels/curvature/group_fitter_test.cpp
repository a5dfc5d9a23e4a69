#include "kernels/curvature/group_fitter.h"

#include <cmath>

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "kernels/surface/normals.h"
#include "tests/support/raw_mesh.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

struct Tally {
  Index solved = 0, alone = 0;
};

// Every vertex by packs and by itself: the same answer wherever packs have one, and they have one wherever the fit of
// one vertex is plain.
Tally check_against_single_fits(const Mesh& m, std::span<const std::uint8_t> ring, const Vec3Array& normal,
                                std::size_t terms, const FitOptions& options = {},
                                std::span<const std::uint8_t> barrier = {}, Real tolerance = 1e-9) {
  GroupFitter together(m, barrier);
  RingWalker walker(m, barrier);
  PointBatch batch;
  Tally tally;
  std::vector<std::uint8_t> met(m.vertex_count());
  for (Index first = 0; first < m.vertex_count(); first += GroupFitter::kGroup) {
    const Index count = std::min(GroupFitter::kGroup, m.vertex_count() - first);
    together.fit(first, ring.subspan(first, count), normal, terms, options, [&](const GroupFitter::Pack& pack) {
      for (std::size_t l = 0; l < kLanes; ++l) {
        if ((pack.active >> l & 1) == 0) continue;
        const Index v = pack.first + static_cast<Index>(l);
        CAPTURE(v);
        CHECK(v < first + count);
        CHECK(ring[v] > 0);
        ++met[v];
        const bool solved = pack.fits.solved >> l & 1;
        solved ? ++tally.solved : ++tally.alone;
        if (!has_normal(normal[v])) {
          CHECK_FALSE(solved);
          continue;
        }
        const VertexFit fit = fit_rings(m, normal, v, Frame(normal[v]), ring[v], terms, options, walker, batch);
        walker.walk(v, ring[v], 1 << 20);
        const bool capped = walker.vertices(ring[v]).size() > RingWalker::kFitCap;
        CHECK(solved == (fit.status == FitStatus::full && !capped));
        if (!solved) continue;
        CHECK(pack.depth[l] == fit.ring);
        CHECK(pack.fits.radius[l] == doctest::Approx(fit.radius).epsilon(1e-13));
        const CubicFit cubic = pack.fits.cubic(l);
        const Real r = fit.radius;
        for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(cubic.b[i] - fit.cubic.b[i]) * r < tolerance);
        for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(cubic.c[i] - fit.cubic.c[i]) * r * r < tolerance);
        for (std::size_t i = 0; i < 2; ++i) CHECK(std::abs(cubic.gradient[i] - fit.cubic.gradient[i]) < tolerance);
      }
    });
  }
  for (Index v = 0; v < m.vertex_count(); ++v) CHECK(met[v] == (ring[v] > 0));
  return tally;
}

Vec3Array normals_of(const Mesh& m) { return vertex_normals(Work{}, m, face_geometry(Work{}, m)); }

std::vector<std::uint8_t> mixed_rings(const Mesh& m, std::uint64_t seed) {
  const Random random(seed, 1);
  std::vector<std::uint8_t> ring(m.vertex_count());
  for (Index v = 0; v < m.vertex_count(); ++v) ring[v] = static_cast<std::uint8_t>(7 * random.uniform(v));
  return ring;
}

}  // namespace

TEST_CASE("packs fit what single vertices fit: closed, bordered, any mix of rings, both kinds of rows") {
  const Mesh closed = raw_mesh(jittered(ellipsoid(4, 3, 2, 1), 0.03, 5));
  const Mesh bordered = raw_mesh(jittered(
      height_field(31, 17, -1, 1, -1, 1, [](Real x, Real y) { return 0.3 * x * x * x - 0.5 * x * y; }), 0.02, 8));
  for (const Mesh* m : {&closed, &bordered}) {
    const Vec3Array normal = normals_of(*m);
    for (std::size_t terms : {7, 9}) {
      const Tally t = check_against_single_fits(*m, mixed_rings(*m, terms), normal, terms);
      CHECK(t.solved > 10 * t.alone);
      check_against_single_fits(*m, std::vector<std::uint8_t>(m->vertex_count(), 3), normal, terms,
                                FitOptions::paper());
    }
  }
}

TEST_CASE("packs stop at barriers, gates and the ends of components") {
  const Mesh m = raw_mesh(jittered(plane(20, 20, Diagonals::alternating), 0.005, 4));
  const Random random(7, 1);
  std::vector<std::uint8_t> barrier(m.edge_count());
  for (Index e = 0; e < m.edge_count(); ++e) barrier[e] = random.uniform(e) < 0.05;
  for (std::size_t terms : {7, 9}) check_against_single_fits(m, mixed_rings(m, 3), normals_of(m), terms, {}, barrier);

  const Mesh box = raw_mesh(cube(6));  // normals of other sides do not pass the gate
  check_against_single_fits(box, mixed_rings(box, 4), normals_of(box), 7);

  Soup s = joined(joined(icosphere(1), plane(3, 3)), plane(2, 2));
  add_vertex(s, Vec3(5, 5, 5));
  const Mesh islands = raw_mesh(s);
  Vec3Array normal = normals_of(islands);
  normal.set(3, Vec3::Zero());  // as on a vertex with degenerate faces only
  const Tally t = check_against_single_fits(islands, mixed_rings(islands, 5), normal, 7);
  CHECK(t.alone > 0);
}

TEST_CASE("poles with more neighbours than a fit takes are left to the fit of one vertex") {
  for (Index spokes : {600u, 5000u}) {
    Soup s;
    add_vertex(s, Vec3::Zero());
    for (Index row = 1; row <= 3; ++row)
      for (Index i = 0; i < spokes; ++i) {
        const Real angle = 6.283185307179586 * i / spokes;
        add_vertex(s, Vec3(row * std::cos(angle), row * std::sin(angle), -0.1 * row * row));
      }
    for (Index i = 0; i < spokes; ++i) {
      const Index j = (i + 1) % spokes;
      add_face(s, 0, 1 + i, 1 + j);
      for (Index a = 1; a <= 1 + spokes; a += spokes) {
        add_face(s, a + i, a + spokes + i, a + spokes + j);
        add_face(s, a + i, a + spokes + j, a + j);
      }
    }
    const Mesh m = raw_mesh(s);
    std::vector<std::uint8_t> ring(m.vertex_count(), 0);
    for (Index v = 0; v < m.vertex_count(); v += 97) ring[v] = 2;
    // Slivers: pivots down to a millionth of the largest.
    const Tally t = check_against_single_fits(m, ring, normals_of(m), 7, {}, {}, 1e-6);
    CHECK(t.alone > 0);
    CHECK(t.solved > 0);
  }
}
