// features(), distance() and evaluate() of the public interface, against closed forms.
#include <cmath>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "graph/api/intarsia.h"
#include "tests/graph/api/plain_mesh.h"

using namespace intarsia;
using test::PlainMesh;

TEST_CASE("a sphere of radius 2 has curvature 1 / 2 everywhere, and normals along the radius") {
  const PlainMesh sphere = test::plain(test::scaled(test::icosphere(4), 2));
  const Result<Features> r = features(sphere.view());
  REQUIRE(r);
  const std::size_t n = sphere.positions.size() / 3;
  REQUIRE(r->kmax.size() == n);
  REQUIRE(r->variation.size() == 6 * n);
  for (std::size_t v = 0; v < n; ++v) {
    CHECK(r->kmax[v] == doctest::Approx(0.5).epsilon(0.02));
    CHECK(r->kmin[v] == doctest::Approx(0.5).epsilon(0.02));
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(r->normals[3 * v + i] == doctest::Approx(sphere.positions[3 * v + i] / 2).epsilon(0.01));
    CHECK(r->scale[v] >= 1);
    CHECK(r->status[v] < 3);
  }
}

TEST_CASE("a vertex that no triangle uses has no fields") {
  PlainMesh sphere = test::plain(test::icosphere(3));
  sphere.positions.insert(sphere.positions.end(), {5, 5, 5});
  const Result<Features> r = features(sphere.view());
  REQUIRE(r);
  CHECK(r->status.back() == 3);
  CHECK(r->kmax.back() == 0);
  CHECK(r->kmax.front() > 0);
}

TEST_CASE("the distance of a shifted square is the shift") {
  const std::vector<std::int32_t> triangles = {0, 1, 2, 0, 2, 3};
  const std::vector<double> low = {0, 0, 0, 3, 0, 0, 3, 4, 0, 0, 4, 0};
  std::vector<double> high = low;
  for (std::size_t v = 0; v < 4; ++v) high[3 * v + 2] = 0.25;
  DistanceOptions options;
  options.samples = 1000, options.keep_samples = true;
  const Result<Distance> r = distance({low, triangles}, {high, triangles}, options);
  REQUIRE(r);
  CHECK(r->hausdorff == doctest::Approx(0.25));
  CHECK(r->mean == doctest::Approx(0.25));
  CHECK(r->rms == doctest::Approx(0.25));
  CHECK(r->diagonal == doctest::Approx(5));
  CHECK(r->forward.area == doctest::Approx(12));
  CHECK(r->vertex_distance.size() == 4);
  CHECK(r->sample_distance.size() == r->forward.samples);
  CHECK(r->sample_point.size() == 3 * r->sample_distance.size());
  for (const double d : r->sample_distance) CHECK(d == doctest::Approx(0.25));
  options.samples = 0;
  CHECK(distance({low, triangles}, {high, triangles}, options).status.code == StatusCode::bad_argument);
  CHECK(distance({low, triangles}, TriangleMesh()).status.code == StatusCode::rejected);
}

TEST_CASE("a cube is its curves: nothing is lost when it is rebuilt from them") {
  const PlainMesh cube = test::plain(test::scaled(test::cube(6), 10));
  const Result<Layout> made = layout(cube.view());
  REQUIRE(made);
  EvaluateOptions options;
  options.samples = 20000;
  const Result<Evaluation> r = evaluate(cube.view(), *made, options);
  INFO(r.status.message);
  REQUIRE(r);
  CHECK(r->patches == 6);
  CHECK(r->not_discs == 0);
  CHECK(r->diagonal == doctest::Approx(10 * std::sqrt(3)));
  for (const Rebuilt* rebuilt : {&r->triangulated, &r->transfinite, &r->filled}) {
    REQUIRE(rebuilt->was_made);
    CHECK(rebuilt->hausdorff < 1e-6);
    CHECK(rebuilt->failed == 0);
    CHECK(rebuilt->patch_rms.size() == 6);
    CHECK(rebuilt->triangles.size() == 3 * rebuilt->triangle_patch.size());
  }
  for (const double c : r->compactness) CHECK(c == doctest::Approx(16 / (4 * 3.14159265358979)));
  CHECK(nlohmann::json::parse(r->report)["patches"] == 6);

  // The same from labels alone.
  const Result<Evaluation> labelled = evaluate(cube.view(), made->labels, options);
  REQUIRE(labelled);
  CHECK(labelled->patches == 6);
  CHECK(labelled->triangulated.hausdorff < 1e-6);
  CHECK(evaluate(cube.view(), std::vector<std::int32_t>{1, 2, 3}, options).status.code == StatusCode::bad_argument);
}

TEST_CASE("a layout of another mesh, or a broken one, is refused") {
  const PlainMesh cube = test::plain(test::cube(4)), other = test::plain(test::cube(2));
  const Result<Layout> made = layout(cube.view());
  REQUIRE(made);
  CHECK(evaluate(other.view(), *made).status.code == StatusCode::bad_argument);
  Layout broken = *made;
  const auto code = [&] { return evaluate(cube.view(), broken).status.code; };
  SUBCASE("node") { broken.network.nodes[0].vertex = -5; }
  SUBCASE("arc") { std::swap(broken.network.arc_vertex[0], broken.network.arc_vertex[2]); }
  SUBCASE("offset") { broken.network.arc_offset.pop_back(); }
  SUBCASE("loop") { broken.network.loop_arc[0] = 99; }
  SUBCASE("order") { broken.network.loop_patch[0] = 5; }
  SUBCASE("patch") { broken.triangle_patch[3] = 6; }
  SUBCASE("parent") { broken.triangle_parent.back() = 1 << 30; }
  CHECK(code() == StatusCode::bad_argument);
}

TEST_CASE("measures can be cancelled") {
  const PlainMesh sphere = test::plain(test::icosphere(4));
  const std::atomic<bool> stop{true};
  DistanceOptions options;
  options.cancel = &stop;
  CHECK(distance(sphere.view(), sphere.view(), options).status.code == StatusCode::cancelled);
  EvaluateOptions how;
  how.progress = [](std::string_view, double) { return false; };
  const std::vector<std::int32_t> one(sphere.triangles.size() / 3, 0);
  CHECK(evaluate(sphere.view(), one, how).status.code == StatusCode::cancelled);
}
