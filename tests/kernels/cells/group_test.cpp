#include <set>

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "tests/kernels/cells/cell_meshes.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

GroupShape shape_of(const CellMesh& m, const std::vector<Index>& cells) {
  std::vector<Index> group(m.cells.count, 0);
  for (const Index c : cells) group[c] = 1;
  GroupScratch scratch;
  return shape_of_group(m.complex, cells, group, {}, 1000, {}, scratch);
}

}  // namespace

TEST_CASE("a whole square: perimeter 4, one loop, a disc, rebuilt exactly") {
  const CellMesh m = checkered_plane(4, 3);
  REQUIRE(m.cells.count == 16);
  std::vector<Index> all(16);
  for (Index c = 0; c < 16; ++c) all[c] = c;
  const GroupShape s = shape_of(m, all);
  CHECK(s.perimeter == doctest::Approx(4).epsilon(1e-12));
  CHECK(s.area == doctest::Approx(1).epsilon(1e-12));
  CHECK(s.loops == 1);
  CHECK(s.euler == 1);
  CHECK(s.defect() == 0);
  CHECK(s.connected);
  CHECK(s.error < 1e-20);
}

TEST_CASE("a ring of cells has two loops, two cells apart are not connected, cells at a corner are pinched") {
  const CellMesh m = checkered_plane(3, 2);
  std::vector<Index> at(9);  // cell of each place
  for (Index f = 0; f < m.surface.mesh.face_count(); ++f) {
    const Vec3 p = m.surface.centroid(f);
    at[static_cast<Index>(p.x() * 3) + 3 * static_cast<Index>(p.y() * 3)] = m.cells.patch_of_face[f];
  }
  const auto group = [&](std::vector<Index> places) {
    for (Index& p : places) p = at[p];
    std::sort(places.begin(), places.end());
    return shape_of(m, places);
  };
  const GroupShape ring = group({0, 1, 2, 3, 5, 6, 7, 8});
  CHECK(ring.loops == 2);
  CHECK(ring.euler == 0);
  CHECK(ring.defect() == 2);
  CHECK(ring.perimeter == doctest::Approx(4 + 4.0 / 3));
  CHECK_FALSE(group({0, 2}).connected);
  CHECK_FALSE(group({0, 4}).connected);                     // they share a vertex only
  const GroupShape pinched = group({1, 2, 3, 5, 6, 7, 8});  // its two ends meet at one corner
  CHECK(pinched.connected);
  CHECK(pinched.defect() > 0);
}

TEST_CASE("unions of cells are measured as patches of faces are") {
  const CellMesh m = cell_mesh(torus(1, 0.4, 24, 12), [](const Vec3& p, const Vec3&) {
    const Real a = std::atan2(p.y(), p.x()) + 4, b = std::atan2(p.z(), std::hypot(p.x(), p.y()) - 1) + 4;
    return static_cast<Index>(a / 0.8) + 16 * static_cast<Index>(b / 1.1);
  });
  const Random random(5, 1);
  int discs = 0, others = 0;
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    std::set<Index> grown;  // half of the trials: any cells; the others: cells beside each other
    const Index wanted = 1 + static_cast<Index>(random.bits(trial, 0) % (m.cells.count / 2));
    for (std::uint64_t draw = 1; grown.size() < wanted; ++draw) {
      Index c = static_cast<Index>(random.bits(trial, draw) % m.cells.count);
      if (trial % 2 && !grown.empty()) {
        const auto from = std::next(grown.begin(), static_cast<std::ptrdiff_t>(c % grown.size()));
        const auto halves = m.complex.cell_halves.row(*from);
        c = m.complex.half_cell[halves[random.bits(trial, draw + 1000000) % halves.size()] ^ 1];
      }
      grown.insert(c);
    }
    const std::vector<Index> chosen(grown.begin(), grown.end());
    std::vector<Index> of_face(m.cells.patch_of_face.size(), 0);
    for (Index f = 0; f < of_face.size(); ++f)
      of_face[f] = std::binary_search(chosen.begin(), chosen.end(), m.cells.patch_of_face[f]) ? 1 : 0;
    std::vector<Index> renamed = of_face;
    if (of_face[0] == 1)
      for (Index& l : renamed) l = 1 - l;
    const PatchTable table = measure_patches(Work(), m.surface, {renamed, 2});
    const Index p = of_face[0] == 1 ? 0 : 1;
    const GroupShape s = shape_of(m, chosen);
    CHECK(s.euler == table.euler[p]);
    CHECK(s.loops == table.loops[p]);
    CHECK(s.perimeter == doctest::Approx(table.perimeter[p]).epsilon(1e-12));
    CHECK(s.area == doctest::Approx(table.area[p]).epsilon(1e-12));
    const PatchLabels pieces = flood_equal(Work(), m.surface.mesh, of_face);
    std::set<Index> own;
    for (Index f = 0; f < of_face.size(); ++f)
      if (of_face[f] == 1) own.insert(pieces.patch_of_face[f]);
    CHECK(s.connected == (own.size() == 1));
    if (s.connected && s.defect() == 0) CHECK(table.is_disc(p));
    (s.connected && table.is_disc(p) ? discs : others) += 1;
  }
  CHECK(discs > 3);
  CHECK(others > 20);
}
