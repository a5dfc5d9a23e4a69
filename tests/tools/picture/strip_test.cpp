#include "tools/picture/strip.h"

#include <array>
#include <atomic>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include "tests/tools/picture/picture_shapes.h"
#include "tools/picture/best_view.h"

using namespace intarsia;
using namespace intarsia::tools;

namespace {

// Two panels of a sphere: plain, and in two colours with its equator.
Strip example(const Triangles& ball, std::vector<Index>& label, const std::vector<Rgb>& colour) {
  Strip strip;
  strip.options.width = strip.options.height = 120;
  Shape shape;
  shape.x = ball.x, shape.y = ball.y, shape.z = ball.z, shape.corner = ball.corner;
  strip.add({.title = "input", .caption = "1640 vertices", .shape = shape, .lines = {}});
  label.resize(shape.face_count());
  for (Index f = 0; f < shape.face_count(); ++f) label[f] = shape.y[shape.corner[3 * f]] > 0 ? 0 : 1;
  shape.face_label = label, shape.label_colour = colour;
  Lines equator;
  std::vector<Vec3> points;
  for (int i = 0; i <= 80; ++i) points.push_back({std::cos(i * 0.0785398), 0, std::sin(i * 0.0785398)});
  equator.add(points, style_of(CurveKind::ridge));
  strip.add({.title = "2 patches", .caption = "", .shape = shape, .lines = equator});
  return strip;
}

const std::vector<Rgb> kTwo = {{240, 180, 90}, {120, 170, 220}};

}  // namespace

TEST_CASE("a strip has the same bytes with one thread and with three") {
  const Triangles ball = sphere(40, 80);
  std::vector<Index> label;
  const Strip strip = example(ball, label, kTwo);
  std::vector<Image> image;
  for (std::size_t threads : {1, 3, 1}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    image.push_back(draw_strip({}, strip));
  }
  CHECK(image[0].pixel == image[1].pixel);
  CHECK(image[0].pixel == image[2].pixel);
}

TEST_CASE("panels stand side by side on white and show their colours") {
  const Triangles ball = sphere(40, 80);
  std::vector<Index> label;
  Strip strip = example(ball, label, kTwo);
  strip.options.view = View{{0, 0.2, 1}, {0, 1, 0}};
  const Image image = draw_strip({}, strip);
  CHECK(image.width > 2 * 120);
  CHECK(image.height > 120);
  const Rgb white = {255, 255, 255};
  for (int x = 0; x < image.width; ++x) CHECK(image.at(x, 0) == white);
  const int panel = (image.width - 3 * 14) / 2, middle = 14 + 14 + panel + panel / 2;
  const Rgb upper = image.at(middle, 14 + 30), lower = image.at(middle, 14 + 90);
  CHECK(upper.r > upper.b + 30);
  CHECK(lower.b > lower.r + 30);
  const Rgb plain = image.at(14 + panel / 2, 14 + 30);
  CHECK(std::abs(plain.r - plain.b) < 10);
  strip.options.per_row = 1;
  CHECK(draw_strip({}, strip).height > image.height + 100);
}

TEST_CASE("panels by themselves are those of the strip, and become files named after them") {
  const Triangles ball = sphere(40, 80);
  std::vector<Index> label;
  Strip strip = example(ball, label, kTwo);
  const Image whole = draw_strip({}, strip);
  const std::vector<Image> panel = draw_panels({}, strip);
  REQUIRE(panel.size() == 2);
  for (int i = 0; i < 2; ++i) {
    const Image& one = panel[static_cast<std::size_t>(i)];
    int different = 0;
    for (int y = 0; y < one.height; ++y)
      for (int x = 0; x < one.width; ++x)
        different += one.at(x, y) == whole.at(14 + i * (one.width + 14) + x, 14 + y) ? 0 : 1;
    CHECK(different == 0);
  }
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("intarsia-panels-" + std::to_string(getpid()));
  write_panels({}, strip, folder / "deeper");
  CHECK(std::filesystem::file_size(folder / "deeper/input.png") > 0);
  CHECK(std::filesystem::file_size(folder / "deeper/2-patches.png") > 0);
  std::filesystem::remove_all(folder);
}

TEST_CASE("a strip without panels, a panel without faces and a picture off its image are refused") {
  CHECK_THROWS_AS(draw_strip({}, Strip{}), Error);
  Strip empty;
  empty.add({.title = "nothing", .caption = "", .shape = {}, .lines = {}});
  CHECK_THROWS_AS(draw_strip({}, empty), Error);
  Scene scene;
  const Triangles b = box({1, 1, 1});
  const Camera camera = fit_camera({}, b.shape(), {});
  prepare_scene({}, b.shape(), camera, 1, {}, scene);
  Image small(10, 10);
  CHECK_THROWS_AS(shade({}, b.shape(), {}, scene, small, 0, 0), Error);
}

TEST_CASE("a cancelled run stops drawing") {
  const Triangles ball = sphere(20, 40);
  std::vector<Index> label;
  const Strip strip = example(ball, label, kTwo);
  const std::atomic<bool> stop{true};
  CHECK_THROWS_AS(draw_strip(Work(&stop, nullptr, Order::fixed), strip), Error);
}

TEST_CASE("the light comes from above: the top of a sphere is brighter than its bottom, and hollows are darker") {
  const Triangles ball = sphere(60, 120);
  FitOptions fit;
  fit.width = fit.height = 100;
  const Image image = render({}, ball.shape(), {}, fit_camera({}, ball.shape(), {{0, 0, 1}, {0, 1, 0}}, fit));
  CHECK(image.at(50, 20).g > image.at(50, 80).g + 40);
  CHECK(image.at(2, 2) == Rgb{255, 255, 255});

  Triangles corner;  // a floor and a wall that meet at the line y = 0, z = 0
  corner.add({-4, 0, 0}, {4, 0, 4}, {4, 0, 0}), corner.add({-4, 0, 0}, {-4, 0, 4}, {4, 0, 4});
  corner.add({-4, 0, 0}, {4, 0, 0}, {4, 4, 0}), corner.add({-4, 0, 0}, {4, 4, 0}, {-4, 4, 0});
  fit.perspective = 0;
  const Camera camera = fit_camera({}, corner.shape(), {{0, 1, 1}, {0, 1, 0}}, fit);
  const Image hollow = render({}, corner.shape(), {}, camera);
  const auto at = [&](const Vec3& p) {
    const Projected q = camera.project(p);
    return static_cast<int>(hollow.at(static_cast<int>(q.x), static_cast<int>(q.y)).g);
  };
  CHECK(at({0, 0.15, 0}) + 5 < at({0, 3, 0}));
  CHECK(at({0, 0, 0.15}) + 5 < at({0, 0, 3}));
}
