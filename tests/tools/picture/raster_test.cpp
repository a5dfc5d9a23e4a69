#include "tools/picture/raster.h"

#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "tests/tools/picture/picture_shapes.h"

using namespace intarsia;
using namespace intarsia::tools;

TEST_CASE("a triangle covers exactly the samples whose centres it holds") {
  // Right angle at (0, 0), legs of 8 pixels: the cells with x + y < 7, 1 + 2 + ... + 7 of them. The centres of those
  // with x + y = 7 lie on the long side, a right and lower edge: by the top-left rule they are not the face's.
  Frame frame;
  Triangles t;
  t.add({0, 0, 0}, {8, 0, 0}, {0, 8, 0});
  rasterise({}, t.shape(), pixel_camera(8, 8), 1, frame);
  int covered = 0;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const bool in = frame.at(x, y) != Frame::kEmpty;
      CHECK(in == (x + y < 7));
      covered += in ? 1 : 0;
    }
  CHECK(covered == 28);
}

TEST_CASE("two triangles share every sample of a rectangle, each exactly once") {
  for (int samples : {1, 3}) {
    std::array<int, 3> count{};
    for (unsigned drawn : {1u, 2u, 3u}) {
      Triangles t;
      if (drawn & 1u) t.add({0, 0, 0}, {8, 0, 0}, {8, 8, 0});
      if (drawn & 2u) t.add({0, 0, 0}, {8, 8, 0}, {0, 8, 0});
      Frame frame;
      rasterise({}, t.shape(), pixel_camera(8, 8), samples, frame);
      for (std::uint64_t k : frame.key) count[drawn - 1] += k != Frame::kEmpty ? 1 : 0;
    }
    CHECK(count[0] + count[1] == count[2]);
    CHECK(count[2] == 64 * samples * samples);
  }
}

TEST_CASE("a fan around an irregular point leaves no gap, narrow or wide") {
  Triangles t;
  const Vec3 hub(37.3, 21.7, 0);
  std::vector<Vec3> rim;
  for (int i = 0; i <= 64; ++i) rim.push_back(Vec3(i, 0, 0));
  for (int i = 1; i <= 64; ++i) rim.push_back(Vec3(64, i, 0));
  for (int i = 63; i >= 0; --i) rim.push_back(Vec3(i, 64, 0));
  for (int i = 63; i >= 1; --i) rim.push_back(Vec3(0, i, 0));
  for (std::size_t i = 0; i < rim.size(); ++i) t.add(hub, rim[i], rim[(i + 1) % rim.size()]);
  Frame frame;
  rasterise({}, t.shape(), pixel_camera(64, 64), 2, frame);
  std::size_t gaps = 0;
  for (std::uint64_t k : frame.key) gaps += k == Frame::kEmpty ? 1 : 0;
  CHECK(gaps == 0);
}

TEST_CASE("the wide path agrees with a point-in-triangle test") {
  const Random random(7, 1);
  for (std::uint64_t round = 0; round < 40; ++round) {
    Triangles t;
    Vec3 p[3];
    for (std::uint64_t i = 0; i < 3; ++i)
      p[i] = {60 * random.uniform(round, 2 * i) + 2, 60 * random.uniform(round, 2 * i + 1) + 2, 0};
    t.add(p[0], p[1], p[2]);
    Frame frame;
    rasterise({}, t.shape(), pixel_camera(64, 64), 1, frame);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        Real least = 1e9, area = 0;
        const Vec3 q(x + 0.5, y + 0.5, 0);
        area = (p[1] - p[0]).cross(p[2] - p[0]).z();
        for (int i = 0; i < 3; ++i) {
          const Vec3 a = p[i], b = p[(i + 1) % 3];
          least = std::min(least, (b - a).cross(q - a).z() * (area < 0 ? -1 : 1) / (b - a).norm());
        }
        if (std::abs(least) > 0.01) CHECK((frame.at(x, y) != Frame::kEmpty) == (least > 0));  // corners are rounded
      }
  }
}

TEST_CASE("the nearer face wins, and of equal faces the lower id") {
  Triangles t;
  t.add({0, 0, -0.5}, {8, 0, -0.5}, {0, 8, -0.5});
  t.add({0, 0, 0.5}, {8, 0, 0.5}, {0, 8, 0.5});  // nearer: the viewer looks along -z
  t.add({0, 0, 0.5}, {8, 0, 0.5}, {0, 8, 0.5});
  Frame frame;
  rasterise({}, t.shape(), pixel_camera(8, 8), 1, frame);
  CHECK(Frame::face_of(frame.at(2, 2)) == 1);
  CHECK(Frame::depth_of(frame.at(2, 2)) == doctest::Approx(0.475).epsilon(1e-6));  // half of 1 - 0.5 / 10
}

TEST_CASE("faces without area, off the picture or too far away are skipped") {
  Triangles t;
  t.add({1, 1, 0}, {5, 5, 0}, {3, 3, 0});
  t.add({2, 2, 0}, {2, 2, 0}, {2, 2, 0});
  t.add({100, 0, 0}, {108, 0, 0}, {100, 8, 0});
  t.add({-1e30, 0, 0}, {1e30, 0, 0}, {0, 1e30, 0});
  Frame frame;
  rasterise({}, t.shape(), pixel_camera(8, 8), 1, frame);
  for (std::uint64_t k : frame.key) CHECK(k == Frame::kEmpty);
}

TEST_CASE("a face larger than the picture is cut to it") {
  Triangles t;
  t.add({-1000, -1000, 0}, {3000, -1000, 0}, {-1000, 3000, 0});
  Frame frame;
  rasterise({}, t.shape(), pixel_camera(8, 8), 2, frame);
  for (std::uint64_t k : frame.key) CHECK(Frame::face_of(k) == 0);
}

TEST_CASE("the number of samples is checked") {
  Triangles t;
  t.add({0, 0, 0}, {8, 0, 0}, {0, 8, 0});
  Frame frame;
  CHECK_THROWS_AS(rasterise({}, t.shape(), pixel_camera(8, 8), 0, frame), Error);
  CHECK_THROWS_AS(rasterise({}, t.shape(), pixel_camera(8, 8), 9, frame), Error);
}
