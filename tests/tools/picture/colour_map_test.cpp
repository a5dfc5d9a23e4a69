#include "tools/picture/colour_map.h"

#include <cmath>

#include <doctest/doctest.h>

#include "tools/picture/oklab.h"

using namespace intarsia;
using namespace intarsia::tools;

TEST_CASE("the map falls in lightness all the way, in steps that look alike") {
  const int steps = 32;
  Lab before = lab_of(map_colour(0));
  Real least = 1, most = 0;
  CHECK(before[0] > 0.92f);
  for (int i = 1; i <= steps; ++i) {
    const Lab lab = lab_of(map_colour(Real(i) / steps));
    CHECK(lab[0] < before[0]);
    const Real step = (lab - before).norm();
    least = std::min(least, step), most = std::max(most, step);
    before = lab;
  }
  CHECK(before[0] < 0.35f);
  CHECK(most < 1.35 * least);
  CHECK(map_colour(-3) == map_colour(0));
  CHECK(map_colour(7) == map_colour(1));
}

TEST_CASE("scales end at round numbers that all but a little weight stays below") {
  std::vector<Real> value(1000);
  for (std::size_t i = 0; i < value.size(); ++i) value[i] = 1e-3 * static_cast<Real>(i);
  const ColourScale all = scale_for(value, {}, "x", 0);
  CHECK(all.top == doctest::Approx(1.0));
  CHECK_FALSE(all.open);
  value[7] = 50;  // one outlier
  const ColourScale most = scale_for(value, {}, "x", 0.005);
  CHECK(most.top == doctest::Approx(1.0));
  CHECK(most.open);
  std::vector<Real> weight(1000, 0.0);
  weight[7] = 1;
  CHECK(scale_for(value, weight, "x").top == doctest::Approx(50));
  CHECK(scale_for(std::vector<Real>(3, 0.0), {}, "x").top == 1);  // nothing to show
  CHECK(scale_for({}, {}, "x").top == 1);
}

TEST_CASE("the bar shows the map from left to right below the picture") {
  const ColourScale scale{0.02, true, "distance"};
  const Image picture(500, 40, {1, 2, 3});
  const Image out = with_scale_bar(picture, scale);
  CHECK(out.width == 500);
  CHECK(out.height == 40 + kScaleBarHeight);
  CHECK(out.at(499, 39) == Rgb{1, 2, 3});
  int found = 0;
  for (int y = 40; y < out.height; ++y)
    for (int x = 1; x < out.width - 1; ++x)
      if (out.at(x, y) == map_colour(0.5) && lab_of(out.at(x - 40, y))[0] > lab_of(out.at(x + 40, y))[0]) ++found;
  CHECK(found > 8);
  Image narrow(30, 20);
  draw_scale_bar(narrow, -10, 10, 300, scale);  // cut, not out of bounds
}
