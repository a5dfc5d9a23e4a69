#include "kernels/cells/inward_directions.h"

#include <numbers>

#include "tests/kernels/cells/cell_meshes.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

TEST_CASE("from the edge of a cube one side goes down, the other across; inside a side they are opposite") {
  const CellMesh m = quartered_cube(6);
  const CellComplex& c = m.complex;
  int edges = 0, inner = 0;
  for (Index a = 0; a < c.arcs(); ++a) {
    const auto p = c.arc_points(a);
    const Vec3 along = (p.back() - p.front()).normalized();
    for (Index i = c.arc_offset[a]; i < c.arc_offset[a + 1]; ++i) {
      const Vec3 &left = c.inward[0][i], &right = c.inward[1][i];
      CHECK(left.norm() == doctest::Approx(1).epsilon(1e-12));
      CHECK(right.norm() == doctest::Approx(1).epsilon(1e-12));
      CHECK(std::abs(left.dot(along)) < 1e-12);
      CHECK(std::abs(right.dot(along)) < 1e-12);
    }
    const Index middle = (c.arc_offset[a] + c.arc_offset[a + 1]) / 2;
    const Real both = c.inward[0][middle].dot(c.inward[1][middle]);
    const bool is_edge = c.salience[a] > 0;
    CHECK(std::abs(both - (is_edge ? 0 : -1)) < 1e-12);
    ++(is_edge ? edges : inner);
  }
  CHECK(edges > 0);
  CHECK(inner > 0);
}

TEST_CASE("along a rounded ridge the second ring says how the flanks leave it") {
  // A gable whose ridge is rounded by the one row of vertices on it: flanks at 45 degrees.
  const TestRefinement t = sharp_refinement(grid(20, 20, false, false, Diagonals::regular,
                                                 [](Real u, Real v) { return Vec3(u, v, 0.5 - std::abs(u - 0.5)); }),
                                            4.0);
  std::vector<Index> ridge;
  const MeshView& mesh = t.refined.mesh;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.point(v).z() > 0.5 - 1e-9) ridge.push_back(v);
  std::sort(ridge.begin(), ridge.end(), [&](Index a, Index b) { return mesh.point(a).y() < mesh.point(b).y(); });
  REQUIRE(ridge.size() == 21);
  std::vector<Vec3> shape, left(ridge.size()), right(ridge.size());
  for (const Index v : ridge) shape.push_back(mesh.point(v));
  inward_directions(mesh, ridge, shape, true, left);
  inward_directions(mesh, ridge, shape, false, right);
  for (std::size_t i = 0; i < ridge.size(); ++i) {
    CHECK((left[i] - Vec3(-std::numbers::sqrt2 / 2, 0, -std::numbers::sqrt2 / 2)).norm() < 1e-9);
    CHECK((right[i] - Vec3(std::numbers::sqrt2 / 2, 0, -std::numbers::sqrt2 / 2)).norm() < 1e-9);
  }
}
