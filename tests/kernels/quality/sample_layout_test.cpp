#include "kernels/quality/sample_layout.h"

#include <cmath>
#include <numbers>

#include "tests/kernels/quality/quality_case.h"

namespace intarsia {

using namespace test;

TEST_CASE("the edges of a cube are sampled evenly and once") {
  const LayoutCase c = identity_case(cube(12), cube_side, CurveKind::sharp);
  const LayoutGraph graph = trace(c);
  REQUIRE(graph.arc_count() == 12);
  const kernels::SampledLayout s = sampled(c, 40);
  CHECK(s.nodes == 8);
  CHECK(s.point.size() == 8 + 12 * 9);  // ten steps an edge
  for (Index a = 0; a < 12; ++a) {
    const auto row = s.arc.row(a);
    REQUIRE(row.size() == 11);
    CHECK(s.point[row.front()] == c.mesh.view().point(graph.node[graph.start[a]]));
    CHECK(s.point[row.back()] == c.mesh.view().point(graph.node[graph.end[a]]));
    for (std::size_t i = 1; i < row.size(); ++i)
      CHECK((s.point[row[i]] - s.point[row[i - 1]]).norm() == doctest::Approx(.1).epsilon(1e-12));
  }
  // A loop runs with its patch on the left, here four sides of ten points.
  for (Index l = 0; l < 6; ++l) {
    kernels::LoopPoints loop;
    kernels::append_loop(s, l, loop);
    CHECK(loop.point.size() == 40);
    CHECK(loop.side == std::vector<Index>{0, 10, 20, 30, 40});
  }
  // Normals: those of the sides.
  for (Index a = 0; a < 12; ++a)
    for (const Index side : {0, 1}) {
      const Index patch = side == 0 ? graph.left[a] : graph.right[a];
      Vec3 expected;
      for (Index f = 0; f < c.mesh.face_count(); ++f)
        if (c.label[f] == patch) {
          const auto [i, j, k] = c.mesh.view().face(f);
          const MeshView m = c.mesh;
          expected = (m.point(j) - m.point(i)).cross(m.point(k) - m.point(i)).normalized();
        }
      const auto row = s.arc.row(a);
      for (std::size_t i = 1; i + 1 < row.size(); ++i) CHECK((s.normal[side][row[i]] - expected).norm() < 1e-12);
      CHECK(s.normal[side][row.front()] == Vec3::Zero());
    }
}

TEST_CASE("an arc takes the larger step of its two patches") {
  // A strip of 1 x 4 cut at x = 1: the long part has the longer border.
  const LayoutCase c = identity_case(
      height_field(40, 10, 0, 4, 0, 1, [](Real, Real) { return 0.0; }),
      [](const MeshView& m, Index f) { return centroid(m, f).x() < 1 ? 0u : 1u; }, CurveKind::sharp);
  const LayoutGraph graph = trace(c);
  const kernels::SampledLayout s = sampled(c, 80);
  for (Index a = 0; a < graph.arc_count(); ++a) {
    const bool shared = graph.left[a] != kNone && graph.right[a] != kNone;
    const bool small = !shared && (graph.left[a] == 0 || graph.right[a] == 0);
    const Real step = graph.length[a] / Real(s.arc.row(a).size() - 1);
    CHECK(step == doctest::Approx(small ? 4.0 / 80 : 8.0 / 80).epsilon(.03));
  }
}

TEST_CASE("normals beside a crease come from behind the faces that touch the curve") {
  // The border runs along the foot of a narrow ramp; the ramp belongs to the upper patch.
  const auto ramp = [](Real x, Real) { return x > .52 ? .2 : 0.0; };
  const LayoutCase c = identity_case(
      height_field(20, 20, 0, 1, 0, 1, ramp),
      [](const MeshView& m, Index f) { return centroid(m, f).x() < .5 ? 0u : 1u; }, CurveKind::sharp);
  const LayoutGraph graph = trace(c);
  const kernels::SampledLayout s = sampled(c, 40);
  Index shared = kNone;
  for (Index a = 0; a < graph.arc_count(); ++a)
    if (graph.left[a] != kNone && graph.right[a] != kNone) shared = a;
  REQUIRE(shared != kNone);
  const auto row = s.arc.row(shared);
  for (std::size_t i = 1; i + 1 < row.size(); ++i)
    for (const int side : {0, 1}) CHECK((s.normal[side][row[i]] - Vec3(0, 0, 1)).norm() < 1e-12);
}

TEST_CASE("arcs never fall together") {
  // Three lunes from pole to pole, so coarse that every arc would be one segment.
  const LayoutCase c = identity_case(
      octasphere(12),
      [](const MeshView& m, Index f) {
        const Vec3 p = centroid(m, f);
        return p.y() < 0 ? 2u : p.x() > 0 ? 0u : 1u;
      },
      CurveKind::sharp);
  const LayoutGraph graph = trace(c);
  REQUIRE(graph.node_count() == 2);
  REQUIRE(graph.arc_count() == 3);
  const kernels::SampledLayout s = sampled(c, 1);
  for (Index a = 0; a < 3; ++a) CHECK(s.arc.row(a).size() >= 3);
}

TEST_CASE("an arc that is a loop of its own has enough points") {
  const LayoutCase c = identity_case(
      capped_cylinder(1, 3, 48, 30), [](const MeshView& m, Index f) { return centroid(m, f).z() < 1e-9 ? 0u : 1u; },
      CurveKind::sharp);
  const kernels::SampledLayout few = sampled(c, 4), many = sampled(c, 100);
  REQUIRE(few.arc.rows() == 1);
  CHECK(few.arc.row(0).size() == 9);
  CHECK(few.arc.row(0).front() == few.arc.row(0).back());
  CHECK(many.arc.row(0).size() == 101);
}

TEST_CASE("sampling does not depend on threads") {
  const LayoutCase c = identity_case(icosphere(4), Nearest{17}, CurveKind::subdivision);
  const kernels::SampledLayout one = run_with_threads(1, [&] { return sampled(c, 120); });
  const kernels::SampledLayout four = run_with_threads(4, [&] { return sampled(c, 120); });
  CHECK(one.arc == four.arc);
  CHECK(one.point.x == four.point.x);
  for (const int side : {0, 1}) {
    CHECK(one.normal[side].x == four.normal[side].x);
    CHECK(one.normal[side].z == four.normal[side].z);
  }
}

}  // namespace intarsia
