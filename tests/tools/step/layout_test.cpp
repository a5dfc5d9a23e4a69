#include <doctest/doctest.h>

#include "tests/support/shapes.h"
#include "tests/tools/step/labelled.h"
#include "tools/step/fit_layout.h"
#include "tools/step/measure_model.h"

using namespace intarsia;
using namespace intarsia::tools;

TEST_CASE("a cube becomes six planes, twelve lines and eight corners, exactly") {
  const test::Labelled cube = test::labelled(test::cube(6), [](const Vec3&, const Vec3& n) {
    int axis = 0;
    n.cwiseAbs().maxCoeff(&axis);
    return static_cast<Index>(2 * axis + (n[axis] > 0 ? 1 : 0));
  });
  const LayoutFit fit = fit_layout({}, cube.refined.mesh, cube.label, cube.graph, 2e-3);
  REQUIRE(fit.model.face.size() == 6);
  REQUIRE(fit.model.edge.size() == 12);
  REQUIRE(fit.model.vertex.size() == 8);
  for (const CadFace& f : fit.model.face) {
    CHECK(f.surface.is_plane);
    REQUIRE(f.loops.size() == 1);
    CHECK(f.loops[0].size() == 4);
  }
  for (const CadEdge& e : fit.model.edge) {
    CHECK(e.is_line);
    CHECK(e.tolerance < 1e-12);
  }
  for (const CadVertex& v : fit.model.vertex)
    for (int k = 0; k < 3; ++k) CHECK(std::min(std::abs(v.point[k]), std::abs(v.point[k] - 1)) < 1e-12);
}

TEST_CASE("a sphere in eight parts: every edge used by two faces in opposite directions, gaps small") {
  const test::Labelled ball = test::labelled(test::icosphere(4), [](const Vec3& p, const Vec3&) {
    return static_cast<Index>((p.x() > 0 ? 1 : 0) + (p.y() > 0 ? 2 : 0) + (p.z() > 0 ? 4 : 0));
  });
  const Real tolerance = 4e-3;
  const LayoutFit fit = fit_layout({}, ball.refined.mesh, ball.label, ball.graph, tolerance);
  REQUIRE(fit.model.face.size() == 8);
  std::vector<int> forward(fit.model.edge.size(), 0), backward(fit.model.edge.size(), 0);
  for (const CadFace& f : fit.model.face)
    for (const auto& loop : f.loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const CadSide &side = loop[i], &next = loop[(i + 1) % loop.size()];
        ++(side.forward ? forward : backward)[side.edge];
        const CadEdge &a = fit.model.edge[side.edge], &b = fit.model.edge[next.edge];
        CHECK((side.forward ? a.end : a.start) == (next.forward ? b.start : b.end));
        const Vec2 end = side.curve.at(side.forward ? side.curve.length : 0);
        const Vec2 begin = next.curve.at(next.forward ? 0 : next.curve.length);
        CHECK((end - begin).norm() < 1e-12);
      }
  for (std::size_t e = 0; e < fit.model.edge.size(); ++e) {
    CHECK(forward[e] == 1);
    CHECK(backward[e] == 1);
    CHECK(fit.model.edge[e].tolerance < 0.5 * tolerance);
  }
  for (const FittedFace& f : fit.layout.face) CHECK(f.inside < tolerance);
  for (const CadVertex& v : fit.model.vertex) CHECK(v.gap < 1e-4 * tolerance);  // surfaces pass through their corners
  // Quarters of great circles at right angles do not cross, and where they meet they only touch.
  EdgeFreedom freedom(ball.graph);
  CHECK(stiffen_crossings({}, fit.model, freedom) == 0);
  for (const Freedom f : freedom.arc) CHECK(f == Freedom::full);
}

TEST_CASE("the deviation of a surface moved along its normal is the distance it was moved") {
  const Soup a = test::plane(8, 8), b = test::transformed(a, [](const Vec3&p) -> Vec3 { return p + Vec3(0, 0, 0.01); });
  const std::vector<Index> label(a.face_count(), 0), face(b.face_count(), 0), patch_face = {0};
  const auto view = [](const Soup& s) { return TrianglesView{Vec3View{s.x, s.y, s.z}, s.corner}; };
  const ModelDeviation d = measure_model({}, view(a), label, patch_face, view(b), face, 1);
  CHECK(d.to_face == doctest::Approx(0.01));
  CHECK(d.to_mesh == doctest::Approx(0.01));
  REQUIRE(d.face.size() == 1);
  CHECK(d.face[0].to_face == doctest::Approx(0.01));
  CHECK(d.face[0].rms == doctest::Approx(0.01));
}
