#include "kernels/scale/group_voting.h"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/support/raw_mesh.h"
#include "tests/support/surface.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

using Variations = std::vector<Variation>;

Variations together(const Mesh& m, bool fold_guard, InstructionSet set, Index* refused = nullptr) {
  const auto faces = voting_faces(Work{}, m);
  GroupVoting voting(m, faces, fold_guard, set);
  Variations out(m.vertex_count());
  for (Index first = 0; first < m.vertex_count(); first += GroupWalker::kGroup) {
    const std::span<Variation> group =
        std::span(out).subspan(first, std::min(GroupWalker::kGroup, m.vertex_count() - first));
    if (voting.run(first, group)) continue;
    REQUIRE(refused);
    *refused += static_cast<Index>(group.size());
  }
  return out;
}

// Single precision against the reference in double precision: 5e-6, relative where a first moment is above 1.
void check_mesh(const Mesh& m) {
  RingWalker walker(m);
  VotingScratch scratch;
  for (const bool guard : {false, true}) {
    const Variations lanes = together(m, guard, instruction_set());
    Real worst = 0, worst_folded = 0;
    for (Index v = 0; v < m.vertex_count(); ++v) {
      const Variation one = variation_of(m, v, guard, walker, scratch);
      for (std::size_t k = 0; k < kRings; ++k) {
        worst = std::max(worst, std::abs(lanes[v].omega[k] - one.omega[k]));
        // Where the moment is near 1 one of them may not count it.
        const Real size = std::max(Real(1), one.folded[k]);
        if (std::abs(size - 1) > 1e-4)
          worst_folded = std::max(worst_folded, std::abs(lanes[v].folded[k] / one.folded[k] - 1));
      }
    }
    CHECK(worst < 5e-6);
    CHECK(worst_folded < 1e-3);
    if (instruction_set() == InstructionSet::baseline) continue;
    for (InstructionSet set : {InstructionSet::avx2, InstructionSet::baseline}) {
      if (set >= instruction_set()) continue;
      const Variations same = together(m, guard, set);
      Index different = 0;
      for (Index v = 0; v < m.vertex_count(); ++v)
        different += same[v].omega != lanes[v].omega || same[v].folded != lanes[v].folded;
      CHECK(different == 0);
    }
  }
}

Soup knife(Real degrees) {
  const Real a = degrees * 3.14159265358979 / 180;
  return row_grid(40, 30, 0.02,
                  [&](Real x, Real y) { return x <= 0 ? Vec3(x, y, 0) : Vec3(x * std::cos(a), y, -x * std::sin(a)); });
}

}  // namespace

TEST_CASE("voting in lanes is voting one by one, on every instruction set") {
  check_mesh(make_surface(ellipsoid(4, 1, 0.7, 0.4)).mesh);
  check_mesh(make_surface(cube(14)).mesh);
  check_mesh(make_surface(jittered(torus(1, 0.3, 60, 24, Diagonals::alternating), 0.02, 8)).mesh);
  check_mesh(make_surface(knife(90)).mesh);
  check_mesh(make_surface(knife(165)).mesh);
  check_mesh(make_surface(joined(plane(9, 9), scaled(icosphere(2), 0.1))).mesh);
}

TEST_CASE("voting in lanes, vertices in any order") {
  check_mesh(raw_mesh(shuffle(scaled(ellipsoid(3, 1, 0.7, 0.4), 0.5), 6)));
}

TEST_CASE("degenerate faces and lonely vertices in lanes") {
  Soup s = scaled(plane(8, 8), 0.7);
  const Index a = add_vertex(s, Vec3(0.35, 0.35, 0)), b = add_vertex(s, Vec3(0.35, 0.35, 0));
  add_face(s, 24, a, b);
  add_vertex(s, Vec3(0, 0, 0.2));
  const Mesh m = raw_mesh(s);
  for (const Variation& v : together(m, true, instruction_set()))
    for (const auto& values : {v.omega, v.folded})
      for (Real w : values) {
        CHECK(w >= 0);
        CHECK(w < 1e-6);
      }
}

TEST_CASE("a pole with thousands of neighbours is left to the walk of one vertex") {
  Soup s;
  const Index spokes = 6000;
  add_vertex(s, Vec3::Zero());
  for (Index i = 0; i < spokes; ++i)
    add_vertex(s, 0.5 * Vec3(std::cos(6.283185307 * i / spokes), std::sin(6.283185307 * i / spokes), 0));
  for (Index i = 0; i < spokes; ++i) add_face(s, 0, 1 + i, 1 + (i + 1) % spokes);
  Index refused = 0;
  together(raw_mesh(s), true, instruction_set(), &refused);
  CHECK(refused == spokes + 1);
}

TEST_CASE("teams that are flat by their cones are flat by their votes") {
  for (const Soup& soup : {ellipsoid(5, 1, 0.7, 0.4), torus(1, 0.3, 400, 160, Diagonals::alternating), cube(40),
                           scaled(plane(30, 30), 0.7)}) {
    const Mesh m = make_surface(soup).mesh;
    const auto faces = voting_faces(Work{}, m);
    const auto cones = normal_cones(Work{}, m, faces);
    const Real flat = 0.1, bent = 0.25;
    Index skipped = 0, wrong = 0;
    GroupVoting voting(m, faces, true), hasty(m, faces, true);
    hasty.skip({cones, safe_chord(flat), safe_chord(bent), 4, kRings});
    Variations all(GroupWalker::kGroup), some(GroupWalker::kGroup);
    for (Index first = 0; first < m.vertex_count(); first += GroupWalker::kGroup) {
      const std::size_t count = std::min(GroupWalker::kGroup, m.vertex_count() - first);
      REQUIRE(voting.run(first, std::span(all).first(count)));
      REQUIRE(hasty.run(first, std::span(some).first(count)));
      for (std::size_t b = 0; b < count; ++b) {
        if (some[b].folded == all[b].folded && some[b].omega == all[b].omega) continue;
        ++skipped;
        for (std::size_t k = 0; k < kRings; ++k) wrong += some[b].folded[k] != 0;
        for (std::size_t k = 0; k < 4; ++k) wrong += all[b].folded[k] >= flat;
        wrong += all[b].folded[5] >= bent;
      }
    }
    CHECK(wrong == 0);
    CHECK(skipped > m.vertex_count() / 3);
  }
}
