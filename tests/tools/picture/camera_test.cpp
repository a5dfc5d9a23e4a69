#include "tools/picture/camera.h"

#include <array>

#include <doctest/doctest.h>

#include "tests/tools/picture/picture_shapes.h"
#include "tools/picture/best_view.h"

using namespace intarsia;
using namespace intarsia::tools;

namespace {

struct Extent {
  Real x0 = 1e9, x1 = -1e9, y0 = 1e9, y1 = -1e9;
};

Extent extent(const Shape& shape, const Camera& camera) {
  Extent e;
  for (Index v : shape.corner) {
    const Projected p = camera.project(shape.point(v));
    e.x0 = std::min(e.x0, p.x), e.x1 = std::max(e.x1, p.x), e.y0 = std::min(e.y0, p.y), e.y1 = std::max(e.y1, p.y);
    CHECK(p.depth >= 0);
    CHECK(p.depth <= 1);
  }
  return e;
}

}  // namespace

TEST_CASE("the object fills the picture up to the margin and is centred, also with unused points far away") {
  Triangles b = box({3, 2, 1});
  b.x.push_back(1e6), b.y.push_back(0), b.z.push_back(0);
  for (Real perspective : {0.0, 0.16, 0.4}) {
    FitOptions fit;
    fit.width = 300, fit.height = 200, fit.margin = 10, fit.perspective = perspective;
    const Extent e = extent(b.shape(), fit_camera({}, b.shape(), {{1, 0.5, 0.8}, {0, 1, 0}}, fit));
    CHECK(e.x0 + e.x1 == doctest::Approx(300));
    CHECK(e.y0 + e.y1 == doctest::Approx(200));
    CHECK(std::max((e.x1 - e.x0) / 280, (e.y1 - e.y0) / 180) == doctest::Approx(1));
  }
}

TEST_CASE("a tight picture is no larger than the object needs") {
  const Triangles b = box({8, 2, 1});
  FitOptions fit;
  fit.width = 600, fit.height = 500, fit.margin = 10, fit.perspective = 0;
  const Camera camera = fit_camera_tightly({}, b.shape(), {{0, 0, 1}, {0, 1, 0}}, fit, 50);
  CHECK(camera.width == 600);
  CHECK(camera.height == 165);  // 580 / 4 and two margins
  const Extent e = extent(b.shape(), camera);
  CHECK(e.x1 - e.x0 == doctest::Approx(580));
}

TEST_CASE("perspective: the nearer of two equal lengths looks longer, and lines stay straight in depth") {
  const Triangles b = box({1, 1, 1});
  const Camera camera = fit_camera({}, b.shape(), {{0, 0, 1}, {0, 1, 0}}, {});
  const auto width_at = [&](Real z) { return camera.project({1, 0, z}).x - camera.project({0, 0, z}).x; };
  CHECK(width_at(1) > 1.1 * width_at(0));
  const Projected a = camera.project({0.1, 0.2, 0}), m = camera.project({0.5, 0.4, 0.5}),
                  c = camera.project({0.9, 0.6, 1});
  const Real t = (m.x - a.x) / (c.x - a.x);
  CHECK(m.y == doctest::Approx(a.y + t * (c.y - a.y)));
  CHECK(m.depth == doctest::Approx(a.depth + t * (c.depth - a.depth)));
  CHECK(c.depth < a.depth);
}

TEST_CASE("a view without a vertical, a picture smaller than its margins and an empty shape are refused") {
  const Triangles b = box({1, 1, 1});
  CHECK_THROWS_AS(fit_camera({}, b.shape(), {{0, 1, 0}, {0, 1, 0}}, {}), Error);
  FitOptions small;
  small.width = 10;
  CHECK_THROWS_AS(fit_camera({}, b.shape(), {}, small), Error);
  CHECK_THROWS_AS(fit_camera({}, {}, {}, {}), Error);
  CHECK_THROWS_AS(best_view({}, {}), Error);
}

TEST_CASE("the best view of a box shows three of its sides from above") {
  const Triangles b = box({3, 2, 2.5});
  const View view = best_view({}, b.shape());
  CHECK(view.toward.norm() == doctest::Approx(1));
  CHECK(view.toward.dot(view.up) > 0.1);
  CHECK(view.toward.cwiseAbs().minCoeff() > 0.08);
}

TEST_CASE("a bowl that is open below stands on its opening, whichever axis is up") {
  for (int axis : {1, 2}) {
    Triangles dome = sphere(40, 40);
    if (axis == 2) dome.y.swap(dome.z), dome.x.swap(dome.y);  // (x, y, z) -> (z, x, y)
    const std::vector<Real>& height = axis == 1 ? dome.y : dome.z;
    std::vector<Index> upper;
    for (std::size_t f = 0; f < dome.corner.size(); f += 3) {
      const Index* v = dome.corner.data() + f;
      if (height[v[0]] > -0.01 && height[v[1]] > -0.01 && height[v[2]] > -0.01) upper.insert(upper.end(), v, v + 3);
    }
    dome.corner = upper;
    CHECK(best_view({}, dome.shape()).up[axis] == 1);
  }
}

TEST_CASE("a direction is found for a single triangle and for a flat sheet") {
  Triangles t;
  t.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  CHECK(best_view({}, t.shape()).toward.norm() == doctest::Approx(1));
  Triangles point;
  point.add({1, 1, 1}, {1, 1, 1}, {1, 1, 1});
  CHECK(best_view({}, point.shape()).toward.norm() == doctest::Approx(1));
}
