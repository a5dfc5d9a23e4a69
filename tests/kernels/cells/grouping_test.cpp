#include <doctest/doctest.h>

#include "kernels/cells/merge_groups.h"
#include "kernels/cells/swap_cells.h"
#include "tests/kernels/cells/cell_meshes.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

std::vector<Index> identity(Index n) {
  std::vector<Index> own(n);
  for (Index c = 0; c < n; ++c) own[c] = c;
  return own;
}

// The cube's side of every cell.
std::vector<Index> sides_of_cells(const CellMesh& m) {
  std::vector<Index> side(m.cells.count);
  for (Index f = 0; f < m.surface.mesh.face_count(); ++f)
    side[m.cells.patch_of_face[f]] = cube_side(m.refinement.normal[f]);
  return side;
}

// A sphere cut into cells by planes across the three axes, in so many steps a radius.
CellMesh boxed_sphere(int levels, Real x, Real y, Real z) {
  return cell_mesh(icosphere(levels), [x, y, z](const Vec3& p, const Vec3&) {
    return static_cast<Index>(x * (p.x() + 1)) + 16 * static_cast<Index>(y * (p.y() + 1)) +
           256 * static_cast<Index>(z * (p.z() + 1));
  });
}

}  // namespace

TEST_CASE("merging the quarters of a cube's sides gives the six sides, rebuilt exactly") {
  const CellMesh m = quartered_cube(2);
  REQUIRE(m.cells.count == 24);
  Grouping g(Work(), m.complex, identity(24), 24, {});
  g.weigh(6);
  CHECK(merge_groups(Work(), 6, g).empty());
  CHECK(g.alive() == 6);
  CHECK(g.total_error() < 1e-20);
  const auto side = sides_of_cells(m);
  for (Index a = 0; a < 24; ++a)
    for (Index b = 0; b < 24; ++b) CHECK((g.group_of(a) == g.group_of(b)) == (side[a] == side[b]));
}

TEST_CASE("merging stops where every union would lose a disc, and says so") {
  // Four strips around a tube: two halves are discs, the whole tube is none.
  const CellMesh m = cell_mesh(cylinder(1, 1, 2, 16, 4), [](const Vec3& p, const Vec3&) {
    return (p.x() > 0 ? Index{1} : Index{0}) + (p.y() > 0 ? Index{2} : Index{0});
  });
  REQUIRE(m.cells.count == 4);
  Grouping g(Work(), m.complex, identity(4), 4, {});
  CHECK_FALSE(merge_groups(Work(), 1, g).empty());
  CHECK(g.alive() == 2);
  GroupOptions any;
  any.discs = false;
  Grouping h(Work(), m.complex, identity(4), 4, any);
  CHECK(merge_groups(Work(), 1, h).empty());
  CHECK(h.alive() == 1);
}

TEST_CASE("a cell on the wrong side of an edge goes back, and the cost never rises") {
  const CellMesh m = quartered_cube(2);
  std::vector<Index> group = sides_of_cells(m);
  // A cell of side 0 beside a cell of another side.
  Index stray = kNone, other = kNone;
  for (const Index h : identity(static_cast<Index>(m.complex.next.size()))) {
    const Index a = m.complex.half_cell[h], b = m.complex.half_cell[h ^ 1];
    if (stray == kNone && a != kNone && b != kNone && group[a] == 0 && group[b] != 0) stray = a, other = group[b];
  }
  REQUIRE(stray != kNone);
  const std::vector<Index> right = group;
  group[stray] = other;
  Grouping g(Work(), m.complex, group, 6, {});
  g.weigh(6);
  const SwapResult r = swap_cells(Work(), {}, g);
  CHECK(r.moves == 1);
  CHECK(r.after < r.before);
  CHECK(g.total_error() < 1e-20);
  for (Index c = 0; c < 24; ++c) CHECK(g.group_of(c) == right[c]);
}

TEST_CASE("refinement lowers the cost, keeps discs, and does not depend on threads") {
  const CellMesh m = boxed_sphere(4, 4, 4, 2);
  const auto run = [&](int threads) {
    return run_with_threads(threads, [&] {
      Grouping g(Work(), m.complex, identity(m.cells.count), m.cells.count, {});
      g.weigh(12);
      merge_groups(Work(), 12, g);
      const Real merged = g.total_cost();
      const SwapResult r = swap_cells(Work(), {}, g);
      CHECK(r.before == doctest::Approx(merged));
      CHECK(r.after <= r.before);
      for (Index k = 0; k < g.size(); ++k)
        if (g.is_alive(k)) CHECK(g.shape(k).defect() == 0);
      return g.spread(m.cells.patch_of_face);
    });
  };
  const auto one = run(1);
  CHECK(run(2) == one);
  CHECK(run(4) == one);
}

TEST_CASE("after refinement every group has the shape that it has when looked at anew") {
  const CellMesh m = boxed_sphere(4, 5, 5, 3);
  Grouping g(Work(), m.complex, identity(m.cells.count), m.cells.count, {});
  g.weigh(9);
  merge_groups(Work(), 9, g);
  std::vector<Index> name(g.size(), kNone), group;
  Index groups = 0;
  for (Index c = 0; c < m.cells.count; ++c) {
    Index& n = name[g.group_of(c)];
    if (n == kNone) n = groups++;
    group.push_back(n);
  }
  Grouping refined(Work(), m.complex, group, groups, g.options());
  CHECK(swap_cells(Work(), {}, refined).moves > 0);
  const Grouping anew(Work(), m.complex, {refined.group_of_cell().begin(), refined.group_of_cell().end()}, groups,
                      g.options());
  for (Index k = 0; k < groups; ++k) {
    CHECK(refined.shape(k).error == anew.shape(k).error);
    CHECK(refined.shape(k).perimeter == anew.shape(k).perimeter);
  }
}

TEST_CASE("the first merge is the cheapest of all unions that are discs") {
  const CellMesh m = boxed_sphere(3, 3, 2, 2);
  Grouping g(Work(), m.complex, identity(m.cells.count), m.cells.count, {});
  g.weigh(12);
  GroupScratch scratch;
  Real least = 1e300;
  std::pair<Index, Index> cheapest{kNone, kNone};
  for (Index a = 0; a < g.size(); ++a)
    for (const Index b : g.neighbours(a)) {
      if (b < a) continue;
      const std::vector<Index> both{a, b};
      const GroupShape u = g.look(both, {}, 0, scratch);
      if (!u.connected || u.defect() > 0) continue;
      const Real cost = cost_of(u, g.options()) - g.cost(a) - g.cost(b);
      if (cost < least) least = cost, cheapest = {a, b};
    }
  REQUIRE(cheapest.first != kNone);
  CHECK(merge_groups(Work(), g.alive() - 1, g).empty());
  CHECK(g.group_of(cheapest.first) == g.group_of(cheapest.second));
}

TEST_CASE("a cost judged at more points is never lower, and the same where patches are rebuilt exactly") {
  const CellMesh cube = quartered_cube(2);
  Grouping six(Work(), cube.complex, sides_of_cells(cube), 6, {});
  six.weigh(6);
  CHECK(six.total_cost_at(Work(), 100) == doctest::Approx(six.total_cost()));
  const CellMesh ball = cell_mesh(icosphere(4), [](const Vec3& p, const Vec3&) {
    return (p.x() > 0.2 ? Index{1} : Index{0}) + (p.y() > 0 ? Index{2} : Index{0}) +
           (p.z() > 0.1 ? Index{4} : Index{0});
  });
  Grouping eight(Work(), ball.complex, identity(ball.cells.count), ball.cells.count, {});
  eight.weigh(8);
  const Real judged = eight.total_cost_at(Work(), 100);
  CHECK(judged >= eight.total_cost());
  CHECK(judged < 1.2 * eight.total_cost());  // smooth caps: where samples fall matters little
}
