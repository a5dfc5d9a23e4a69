#include "engine/space/outline.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

using namespace intarsia;

namespace {

void add_square(Outline& o, Real size, Real z, bool reversed) {
  const Real s = size / 2;
  std::vector<Vec3> corner{{-s, -s, z}, {s, -s, z}, {s, s, z}, {-s, s, z}};
  if (reversed) std::reverse(corner.begin(), corner.end());
  for (std::size_t k = 0; k < 4; ++k) {
    o.point.push_back(corner[k]), o.point.push_back(corner[(k + 1) % 4]);
    o.end_piece();
  }
  o.end_loop();
}

}  // namespace

TEST_CASE("points above a square: the error is the weight times the squared height") {
  Outline o;
  add_square(o, 2, 0, false);
  CHECK(o.length() == doctest::Approx(8));
  WeightedPoints samples;
  samples.add({0.3, -0.2, 0.5}, 3);
  samples.add({-0.9, 0.9, -0.1}, 2);
  OutlineScratch scratch;
  CHECK(outline_error(o, samples, {}, scratch) == doctest::Approx(3 * 0.25 + 2 * 0.01).epsilon(1e-12));
}

TEST_CASE("a flat ring is rebuilt as a ring: a point in its hole is far from it") {
  Outline o;
  add_square(o, 4, 0, false), add_square(o, 2, 0, true);
  WeightedPoints ring, hole;
  ring.add({1.5, 0.2, 0}, 1), ring.add({-1.2, -1.7, 0}, 1);
  hole.add({0, 0, 0}, 1);
  OutlineScratch scratch;
  CHECK(outline_error(o, ring, {}, scratch) < 1e-20);
  CHECK(outline_error(o, hole, {}, scratch) == doctest::Approx(1));
}

TEST_CASE("a circle: the error of its centre plane is zero, and without loops that of the mean") {
  Outline o;
  for (int k = 0; k <= 200; ++k) {
    const Real a = 2 * std::numbers::pi * k / 200;
    o.point.push_back({std::cos(a), std::sin(a), 1});
  }
  o.end_piece(), o.end_loop();
  WeightedPoints samples;
  samples.add({0, 0, 1}, 1), samples.add({0.2, 0, 3}, 1);
  OutlineScratch scratch;
  CHECK(outline_error(o, samples, {}, scratch) == doctest::Approx(4));
  CHECK(outline_error(Outline(), samples, {}, scratch) == doctest::Approx(2 * (0.01 + 1)));
}

TEST_CASE("smoothing keeps the ends, straight lines, and takes out a zigzag") {
  std::vector<Vec3> straight, zigzag;
  for (int k = 0; k <= 20; ++k) {
    straight.push_back({0.1 * k, 0, 0});
    zigzag.push_back({0.1 * k, k % 2 ? 0.05 : 0.0, 0});
  }
  const auto ends = std::pair{zigzag.front(), zigzag.back()};
  auto same = straight;
  smooth_polyline(same, 10);
  for (std::size_t k = 0; k < same.size(); ++k) CHECK((same[k] - straight[k]).norm() < 1e-14);
  smooth_polyline(zigzag, 10);
  CHECK(zigzag.front() == ends.first);
  CHECK(zigzag.back() == ends.second);
  Real length = 0;
  for (std::size_t k = 1; k < zigzag.size(); ++k) length += (zigzag[k] - zigzag[k - 1]).norm();
  CHECK(length < 2.01);  // from 2.24
}

TEST_CASE("the coarse error is no more than the error, which does not mind being told it") {
  Outline o;
  for (int k = 0; k <= 200; ++k) {
    const Real a = 2 * std::numbers::pi * k / 200;
    o.point.emplace_back(std::cos(a), std::sin(a), 0.3 * std::sin(3 * a));
  }
  o.end_piece(), o.end_loop();
  WeightedPoints samples;
  for (int k = 0; k < 60; ++k) samples.add({0.9 * std::cos(k), 0.9 * std::sin(k), 0.1 * std::cos(2.0 * k)}, 0.05);
  OutlineScratch scratch;
  const Real coarse = coarse_outline_error(o, samples, {}, scratch), all = outline_error(o, samples, {}, scratch);
  CHECK(coarse > 0);
  CHECK(coarse <= all);
  CHECK(outline_error(o, samples, {}, scratch, coarse) == all);
}

TEST_CASE("a piece of a pipe is spanned along its length, and its directions tell how round it is") {
  // Two straight sides and two half circles; samples on the pipe.
  Outline o;
  WeightedPoints samples;
  constexpr int kSteps = 40;
  const Real half = 0.6;
  const auto at = [&](Real x, Real angle) { return Vec3(x, std::sin(angle), std::cos(angle)); };
  const auto side = [&](Real angle, Real from, Real to) {
    for (int k = 0; k <= kSteps; ++k) {
      o.point.push_back(at(from + (to - from) * k / kSteps, angle));
      o.inward.push_back((angle < 0 ? 1 : -1) * Vec3(0, std::cos(angle), -std::sin(angle)));
    }
    o.end_piece();
  };
  const auto arc = [&](Real x, Real from, Real to) {
    for (int k = 0; k <= kSteps; ++k) {
      o.point.push_back(at(x, from + (to - from) * k / kSteps));
      o.inward.push_back({x > 0 ? -1.0 : 1.0, 0, 0});
    }
    o.end_piece();
  };
  side(-half, 0, 1.5), arc(1.5, -half, half), side(half, 1.5, 0), arc(0, half, -half);
  o.end_loop();
  for (int i = 1; i < 12; ++i)
    for (int k = -5; k <= 5; ++k) samples.add(at(0.125 * i, half * k / 6), 1.0 / 121);
  OutlineScratch scratch;
  OutlineOptions flat, bent;
  // The least area is a soap film, which sags; only a high price of bends keeps the pipe's own chords.
  flat.loops.polygon = {.bend_weight = 0.6, .exact = true}, flat.second_points = 0;
  bent = flat;
  flat.bent = 0, bent.bent = 1;
  const Real by_flat = outline_error(o, samples, flat, scratch);
  const Real both = outline_error(o, samples, bent, scratch);
  // Chords between the two half circles run along the pipe: off by no more than their sagitta.
  CHECK(by_flat < 1e-4);
  CHECK(both >= by_flat);
  CHECK(both - by_flat < by_flat + 1e-4);  // bending does no harm here
}

TEST_CASE("a weaker price of bends in the second count never lowers the error below either") {
  Outline o;
  for (int k = 0; k <= 60; ++k) {
    const Real a = 2 * std::numbers::pi * k / 60;
    o.point.push_back({std::cos(a), std::sin(a), 0.8 * std::cos(2 * a)});
  }
  o.end_piece(), o.end_loop();
  WeightedPoints samples;
  for (int k = 0; k < 20; ++k) samples.add({0.04 * k - 0.4, 0.03 * k - 0.3, 0.1}, 0.05);
  OutlineScratch scratch;
  OutlineOptions all, first;
  first.second_points = 0;
  const Real worse = outline_error(o, samples, all, scratch), one = outline_error(o, samples, first, scratch);
  const Real coarse = coarse_outline_error(o, samples, all, scratch);
  CHECK(worse == std::max(one, coarse));
}
