#include "tools/picture/font.h"

#include <set>
#include <string>

#include <doctest/doctest.h>

using namespace intarsia::tools;

namespace {

Image letter(char c) {
  Image image(48, 48);
  draw_text(image, 8, 32, std::string(1, c), {24, 0.12f, {0, 0, 0}});
  return image;
}

std::string bytes(const Image& image) {
  std::string s;
  for (Rgb p : image.pixel) s.push_back(static_cast<char>(p.g));
  return s;
}

}  // namespace

TEST_CASE("every printable ASCII character has a shape of its own") {
  std::set<std::string> shapes;
  for (char c = ' '; c <= '~'; ++c) {
    const Image image = letter(c);
    int dark = 0;
    for (Rgb p : image.pixel) dark += p.g < 128 ? 1 : 0;
    if (c == ' ') CHECK(dark == 0);
    if (c != ' ') CHECK(dark >= 6);
    shapes.insert(bytes(image));
  }
  CHECK(shapes.size() == 95);
  CHECK(shapes.count(bytes(letter('\x01'))) == 0);
}

TEST_CASE("ink stays within the advance and between ascender and descender") {
  for (char c = '!'; c <= '~'; ++c) {
    const Image image = letter(c);
    const float right = 8 + text_width(std::string(1, c), {24, 0.12f, {}});
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 48; ++x)
        if (image.at(x, y).g < 128) {
          CHECK(x >= 6);
          CHECK(static_cast<float>(x) <= right);
          CHECK(y >= 3);
          CHECK(y <= 42);
        }
  }
}

TEST_CASE("widths add up and grow with the size") {
  const TextStyle style;
  CHECK(text_width("", style) == 0);
  CHECK(text_width("ab", style) == doctest::Approx(text_width("a", style) + text_width("b", style)));
  CHECK(text_width("42 patches", {20, 0.1f, {}}) == doctest::Approx(2 * text_width("42 patches", {10, 0.1f, {}})));
}

TEST_CASE("text that leaves the image is cut") {
  Image image(20, 10);
  draw_text(image, -30, 5, "network", {});
  draw_text(image, 15, 100, "network", {});
  draw_stroke(image, -5, -5, 40, 40, 3, {0, 0, 0});
  CHECK(image.at(0, 0).r < 128);
}
