#include "tools/picture/lines.h"

#include <array>

#include <doctest/doctest.h>

#include "tests/tools/picture/picture_shapes.h"

using namespace intarsia;
using namespace intarsia::tools;

namespace {

Frame wall(Real z) {
  Triangles t;
  t.add({0, 0, z}, {64, 0, z}, {0, 64, z});
  t.add({64, 0, z}, {64, 64, z}, {0, 64, z});
  Frame frame;
  Camera camera = pixel_camera(32, 32);
  camera.radius = 100;
  rasterise({}, t.shape(), camera, 1, frame);
  return frame;
}

std::size_t painted(const Frame& frame, const Lines& lines, std::uint32_t id) {
  std::vector<std::uint32_t> line;
  draw_lines({}, frame, lines, line);
  std::size_t n = 0;
  for (std::uint32_t i : line) n += i == id ? 1 : 0;
  return n;
}

}  // namespace

TEST_CASE("a line in front of a face or on it is seen, behind it is hidden") {
  const Frame frame = wall(0);
  for (const auto& [z, seen] : {std::pair{20.0, true}, {0.0, true}, {-20.0, false}}) {
    Lines lines;
    const std::array<Vec3, 2> ends = {Vec3(4, 16, z), Vec3(28, 16, z)};
    lines.add(ends, {{255, 0, 0}, 2});
    const std::size_t n = painted(frame, lines, 1);
    if (seen) CHECK(n == 52);  // columns 3 to 28 of two rows: their centres are at most 1 from the segment
    if (!seen) CHECK(n == 0);
  }
}

TEST_CASE("a line on a steep surface keeps its full width") {
  Triangles t;  // rises by one and a half in depth for each pixel in y
  t.add({0, 0, 0}, {64, 0, 0}, {0, 64, 96});
  t.add({64, 0, 0}, {64, 64, 96}, {0, 64, 96});
  Frame frame;
  Camera camera = pixel_camera(32, 32);
  camera.radius = 100;
  rasterise({}, t.shape(), camera, 3, frame);
  Lines lines;
  const std::array<Vec3, 2> ends = {Vec3(-10, 16, 24), Vec3(42, 16, 24)};
  lines.add(ends, {{0, 0, 0}, 2});
  CHECK(painted(frame, lines, 1) == 96 * 6);
}

TEST_CASE("later lines are painted over earlier ones") {
  const Frame frame = wall(0);
  Lines lines;
  const std::array<Vec3, 2> across = {Vec3(-4, 16, 0), Vec3(36, 16, 0)}, down = {Vec3(16, -4, 0), Vec3(16, 36, 0)};
  lines.add(across, {{255, 0, 0}, 2});
  lines.add(down, {{0, 0, 255}, 2});
  CHECK(painted(frame, lines, 2) == 64);
  CHECK(painted(frame, lines, 1) == 60);
}

TEST_CASE("points, empty lines and lines off the picture do no harm") {
  const Frame frame = wall(0);
  Lines lines;
  const std::array<Vec3, 2> point = {Vec3(16, 16, 0), Vec3(16, 16, 0)},
                            outside = {Vec3(-90, -90, 0), Vec3(-50, -9e9, 0)};
  lines.add(point, {{255, 0, 0}, 4});
  lines.add({}, {{255, 0, 0}, 2});
  lines.add(std::span(point).first(1), {{255, 0, 0}, 2});
  lines.add(outside, {{255, 0, 0}, 2});
  CHECK(painted(frame, lines, 1) == 12);  // a disc of radius 2
  CHECK(painted(frame, lines, 2) + painted(frame, lines, 3) + painted(frame, lines, 4) == 0);
}

TEST_CASE("curves of a network are drawn where they lie, important kinds last") {
  Mesh mesh;
  mesh.x = {0, 1, 0}, mesh.y = {0, 0, 1}, mesh.z = {0, 0, 0}, mesh.corner = {0, 1, 2};
  CurveNetwork network;
  for (Index v = 0; v < 3; ++v) network.point.push_back(SurfacePoint::at_vertex(v));
  network.point.push_back(SurfacePoint::in_face(0, 0.5, 0.25));
  network.add_curve({0, 3}, CurveKind::ridge);
  network.add_curve({1, 2}, CurveKind::extension);
  const Lines lines = lines_of(mesh, network);
  REQUIRE(lines.count() == 2);
  CHECK(lines.style[0].colour == style_of(CurveKind::extension).colour);
  CHECK(lines.style[1].colour == style_of(CurveKind::ridge).colour);
  CHECK((lines.point[3] - Vec3(0.25, 0.25, 0)).norm() < 1e-15);
}
