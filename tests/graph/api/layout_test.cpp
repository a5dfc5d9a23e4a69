// The public interface: known layouts, errors as statuses, progress, cancel, threads.
#include <cmath>
#include <thread>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "graph/api/intarsia.h"
#include "tests/graph/api/plain_mesh.h"

using namespace intarsia;
using test::PlainMesh;

TEST_CASE("a cube has six patches, twelve sharp arcs and eight nodes") {
  const PlainMesh cube = test::plain(test::cube(8));
  const Result<Layout> r = layout(cube.view());
  REQUIRE(r.status.code == StatusCode::ok);
  CHECK(r.status.exit_status() == 0);
  CHECK(r->patches.size() == 6);
  CHECK(r->network.nodes.size() == 8);
  CHECK(r->network.arcs.size() == 12);
  CHECK(r->diagonal == doctest::Approx(std::sqrt(3)));
  for (const Arc& arc : r->network.arcs) {
    CHECK(arc.kind == ArcKind::sharp);
    CHECK(arc.length == doctest::Approx(1));
    CHECK(arc.left != arc.right);
  }
  for (const Patch& patch : r->patches) {
    CHECK(patch.area == doctest::Approx(1));
    CHECK(patch.perimeter == doctest::Approx(4));
    CHECK(patch.flatness == doctest::Approx(1));
    CHECK(patch.is_disc);
  }
  for (const Node& node : r->network.nodes) {
    CHECK(node.degree == 3);
    for (const double x : node.position) CHECK(std::abs(x - 0.5) == doctest::Approx(0.5));
  }
  // Triangles of one side, and only those, have one label.
  std::map<int, std::set<int>> sides;
  for (std::size_t t = 0; t < cube.triangles.size() / 3; ++t) {
    double sum[3] = {};
    for (int i = 0; i < 3; ++i)
      for (int axis = 0; axis < 3; ++axis)
        sum[axis] += cube.positions[3 * static_cast<std::size_t>(cube.triangles[3 * t + static_cast<std::size_t>(i)]) +
                                    static_cast<std::size_t>(axis)];
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(sum[axis] - 1.5) > 1.5 - 1e-9) sides[sum[axis] > 1 ? axis : 3 + axis].insert(r->labels[t]);
  }
  CHECK(sides.size() == 6);
  for (const auto& [side, labels] : sides) CHECK(labels.size() == 1);
  // The layout mesh begins with the input's vertices.
  CHECK(std::equal(cube.positions.begin(), cube.positions.end(), r->vertices.begin()));
  const auto report = nlohmann::json::parse(r->report);
  CHECK(report["counts"]["patches"] == 6);
  CHECK(report["hash"] == r->hash);
}

TEST_CASE("32 and 64 bits, and any number of threads, give the same") {
  const PlainMesh cube = test::plain(test::icosphere(3));
  const std::vector<std::int64_t> wide(cube.triangles.begin(), cube.triangles.end());
  Options options;
  options.patches = 12;
  const Result<Layout> first = layout(cube.view(), options);
  REQUIRE(first);
  for (const int threads : {1, 2, 3}) {
    options.threads = threads;
    const Result<Layout> r = layout(TriangleMesh(cube.positions, wide), options);
    CHECK(r->hash == first->hash);
    CHECK(r->labels == first->labels);
    CHECK(r->vertices == first->vertices);
    CHECK(r->network.arc_vertex == first->network.arc_vertex);
  }
}

TEST_CASE("calls side by side do not disturb each other") {
  const PlainMesh cube = test::plain(test::cube(6));
  const std::string alone = layout(cube.view())->hash;
  std::string a, b;
  std::thread one([&] { a = layout(cube.view())->hash; }), other([&] { b = layout(cube.view())->hash; });
  one.join(), other.join();
  CHECK(a == alone);
  CHECK(b == alone);
}

TEST_CASE("what is wrong comes back as a status that names it") {
  PlainMesh cube = test::plain(test::cube(6));
  const auto status = [&] { return layout(cube.view()).status; };
  SUBCASE("a vertex that does not exist") {
    cube.triangles[3 * 7 + 1] = 1'000'000;
    CHECK(status().code == StatusCode::rejected);
    CHECK(status().element == 7);
    CHECK(status().message.find("1000000") != std::string::npos);
    CHECK(status().exit_status() == 4);
  }
  SUBCASE("a negative vertex") {
    cube.triangles[5] = -1;
    CHECK(status().code == StatusCode::rejected);
    CHECK(status().element == 1);
  }
  SUBCASE("no number") {
    cube.positions[4] = std::nan("");
    CHECK(status().code == StatusCode::rejected);
  }
  SUBCASE("not three numbers a vertex") {
    cube.positions.push_back(0);
    CHECK(status().code == StatusCode::bad_argument);
    CHECK(status().exit_status() == 2);
  }
  SUBCASE("nothing") {
    const Result<Layout> r = layout(TriangleMesh());
    CHECK(r.status.code == StatusCode::rejected);
    CHECK(!r);
    CHECK(r->labels.empty());
  }
  SUBCASE("strict") {
    std::swap(cube.triangles[0], cube.triangles[1]);
    Options options;
    options.strict = true;
    CHECK(layout(cube.view(), options).status.code == StatusCode::rejected);
    const Result<Layout> mended = layout(cube.view());
    CHECK(mended->patches.size() == 6);
    CHECK(!mended->remarks.empty());
  }
  SUBCASE("too little memory") {
    Options options;
    options.max_memory = 1000;
    CHECK(layout(cube.view(), options).status.code == StatusCode::no_memory);
  }
  SUBCASE("no time at all") {
    Options options;
    options.time_limit = 1e-9;
    CHECK(layout(cube.view(), options).status.code == StatusCode::out_of_time);
    CHECK(features(cube.view(), options).status.code == StatusCode::out_of_time);
    options.time_limit = 1000;
    CHECK(features(cube.view(), options).status.code == StatusCode::ok);
  }
  SUBCASE("a negative number of threads") {
    Options options;
    options.threads = -1;
    CHECK(layout(cube.view(), options).status.code == StatusCode::bad_argument);
  }
  SUBCASE("a size that is none") {
    Options options;
    options.min_feature = "much";
    CHECK(layout(cube.view(), options).status.code == StatusCode::bad_argument);
  }
}

TEST_CASE("given curves and pinned regions are kept") {
  const PlainMesh cube = test::plain(test::cube(8));
  Options options;
  options.curves = {{0, 0.5, 1, 1, 0.5, 1}};  // halves the top
  const Result<Layout> r = layout(cube.view(), options);
  REQUIRE(r);
  CHECK(r->patches.size() == 7);
  double length = 0;
  for (const Arc& arc : r->network.arcs)
    if (arc.kind == ArcKind::given) length += arc.length;
  CHECK(length == doctest::Approx(1));
  options.curves = {{0, 0.5, 1}};
  CHECK(layout(cube.view(), options).status.code == StatusCode::bad_argument);
  options.curves.clear();
  options.pins = {1, 2, 3};
  CHECK(layout(cube.view(), options).status.code == StatusCode::bad_argument);
  options.pins.clear();
  options.tolerance = "1%";
  const auto report = nlohmann::json::parse(layout(cube.view(), options)->report);
  CHECK(report["tolerance"]["rms_relative"].get<double>() <= 0.01);
  options.patches = 5;
  CHECK(layout(cube.view(), options).status.code == StatusCode::bad_argument);
}

TEST_CASE("options are set by name, in range, and a wrong name gets a suggestion") {
  Options options;
  CHECK(options.set("smooth.iterations", 3).code == StatusCode::ok);
  const Status wrong = options.set("smooth.iteration", 3);
  CHECK(wrong.code == StatusCode::bad_argument);
  CHECK(wrong.message.find("smooth.iterations") != std::string::npos);
  CHECK(options.set("smooth.iterations", 2.5).code == StatusCode::bad_argument);
  CHECK(options.set("smooth.iterations", -1).code == StatusCode::bad_argument);
  CHECK(options.set("sharp.strong", std::nan("")).code == StatusCode::bad_argument);
  CHECK(options.method.size() == 1);
  for (const OptionInfo& o : method_options()) {
    CAPTURE(o.name);
    CHECK(!o.help.empty());
    CHECK(options.set(o.name, o.value).code == StatusCode::ok);
  }
  options.method["no.such"] = 1;
  const PlainMesh cube = test::plain(test::cube(4));
  CHECK(layout(cube.view(), options).status.code == StatusCode::bad_argument);
}

TEST_CASE("progress grows to 1 and can cancel") {
  const PlainMesh sphere = test::plain(test::icosphere(3));
  Options options;
  double last = 0;
  std::set<std::string> stages;
  options.progress = [&](std::string_view stage, double fraction) {
    CHECK(fraction >= last);
    last = fraction;
    stages.insert(std::string(stage));
    return true;
  };
  REQUIRE(layout(sphere.view(), options));
  CHECK(last == 1);
  for (const char* name : {"read", "surface", "curvature", "network", "layout"}) CHECK(stages.contains(name));

  options.progress = [](std::string_view stage, double) { return stage != "ridges"; };
  const Result<Layout> cancelled = layout(sphere.view(), options);
  CHECK(cancelled.status.code == StatusCode::cancelled);
  CHECK(cancelled.status.exit_status() == 130);
  CHECK(cancelled->labels.empty());

  options.progress = [](std::string_view, double) -> bool { throw std::runtime_error("no"); };
  CHECK(layout(sphere.view(), options).status.code == StatusCode::cancelled);

  options.progress = nullptr;
  const std::atomic<bool> stop{true};
  options.cancel = &stop;
  CHECK(layout(sphere.view(), options).status.code == StatusCode::cancelled);
}

TEST_CASE("versions of header and library are the same") {
  CHECK(std::string(version()) == std::to_string(INTARSIA_VERSION_MAJOR) + "." +
                                      std::to_string(INTARSIA_VERSION_MINOR) + "." +
                                      std::to_string(INTARSIA_VERSION_PATCH));
}
