#include "tools/make/truth.h"

#include <cmath>
#include <fstream>

#include <doctest/doctest.h>

using namespace intarsia;
using namespace intarsia::tools;

namespace {

Real length(const TrueCurve& c) {
  Real l = 0;
  for (std::size_t i = 1; i < c.point.size(); ++i) l += (c.point[i] - c.point[i - 1]).norm();
  return c.closed ? l + (c.point.front() - c.point.back()).norm() : l;
}

MakeOptions shape(const std::string& name) {
  MakeOptions o;
  o.shape = name;
  return o;
}

}  // namespace

TEST_CASE("true features lie on the surface, where a shape says it has them") {
  for (const ShapeInfo& info : shapes()) {
    CAPTURE(info.name);
    const MakeOptions o = shape(info.name);
    const TrueFeatures f = true_features(o);
    CHECK(info.has_truth == !f.curves.empty());
    const ShapeDistance distance(o);
    for (const TrueCurve& c : f.curves) {
      CHECK(c.point.size() >= 2);
      for (const Vec3& p : c.point) CHECK(distance(p) < 1e-12);
    }
    for (const Vec3& p : f.corners) CHECK(distance(p) < 1e-12);
  }
}

TEST_CASE("numbers and lengths of the features") {
  const TrueFeatures ellipsoid = true_features(shape("ellipsoid"), 4000);
  REQUIRE(ellipsoid.curves.size() == 1);
  CHECK(ellipsoid.curves[0].closed);
  CHECK(length(ellipsoid.curves[0]) == doctest::Approx(15.865).epsilon(1e-4));
  for (const Vec3& p : ellipsoid.curves[0].point) CHECK(p.z() == 0);

  MakeOptions prolate = shape("ellipsoid");
  prolate.parameters = {{"b", 1.0}};
  CHECK(true_features(prolate).curves.empty());

  const TrueFeatures box = true_features(shape("rounded-box"));
  CHECK(box.curves.size() == 12);
  CHECK(box.corners.size() == 8);
  for (const TrueCurve& c : box.curves) CHECK(length(c) == doctest::Approx(1.5).epsilon(1e-12));
  MakeOptions ball = shape("rounded-box");
  ball.parameters = {{"fillet", 1.0}};
  CHECK(true_features(ball).curves.empty());

  const TrueFeatures cube = true_features(shape("cube"));
  CHECK(cube.curves.size() == 12);
  CHECK(cube.corners.size() == 8);
  for (const TrueCurve& c : cube.curves) CHECK(length(c) == doctest::Approx(2).epsilon(1e-12));

  CHECK(true_features(shape("star")).curves.size() == 8);
  const TrueFeatures pipe = true_features(shape("half-pipe"));
  REQUIRE(pipe.curves.size() == 2);
  for (const TrueCurve& c : pipe.curves) CHECK(length(c) == doctest::Approx(4).epsilon(1e-12));
  CHECK(pipe.curves[0].point[0].x() == doctest::Approx(-1.15 + 0.15 * std::sqrt(0.5)).epsilon(1e-12));
  CHECK(pipe.curves[1].point[0].x() == doctest::Approx(1.15 - 0.15 * std::sqrt(0.5)).epsilon(1e-12));
}

TEST_CASE("the star's crests are ridges of its radius along each circle of latitude, within the crest's width") {
  // On the equator the crest is the farthest point from the axis.
  const TrueFeatures star = true_features(shape("star"), 3);
  MakeOptions o = shape("star");
  const ShapeDistance distance(o);
  for (const TrueCurve& c : star.curves) {
    const Vec3 tip = c.point[1];
    CHECK(tip.z() == doctest::Approx(0));
    const Real r = tip.norm();
    for (const Real turn : {-0.05, 0.05}) {
      const Vec3 beside(tip.x() * std::cos(turn) - tip.y() * std::sin(turn),
                        tip.x() * std::sin(turn) + tip.y() * std::cos(turn), 0);
      CHECK(distance(beside) > 1e-3);  // the surface has dropped below this circle
    }
    CHECK(r > 1.3);
  }
}

TEST_CASE("features as OBJ") {
  const auto path = std::filesystem::temp_directory_path() / ("truth_test-" + std::to_string(std::rand()) + ".obj");
  write_truth(true_features(shape("ellipsoid"), 50), path);
  std::ifstream in(path);
  std::string word, line;
  int vertices = 0, lines = 0, ends = 0;
  while (std::getline(in, line)) {
    if (line.rfind("v ", 0) == 0) ++vertices;
    if (line.rfind("l 1 2 ", 0) == 0) ++lines, ends += line.substr(line.size() - 5) == " 50 1";
  }
  CHECK(vertices == 50);
  CHECK(lines == 1);
  CHECK(ends == 1);
  std::filesystem::remove(path);
}
