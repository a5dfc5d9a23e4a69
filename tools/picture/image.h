// RGB pixels, rows from the top.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace intarsia::tools {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

// Mixes in display space: weight 0 gives a, 1 gives b.
inline Rgb mix(Rgb a, Rgb b, float weight) {
  const auto one = [weight](std::uint8_t p, std::uint8_t q) {
    const float v = static_cast<float>(p) + weight * (static_cast<float>(q) - static_cast<float>(p));
    return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 255.0f) + 0.5f);
  };
  return {one(a.r, b.r), one(a.g, b.g), one(a.b, b.b)};
}

struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixel;

  Image() = default;
  Image(int w, int h, Rgb fill = {255, 255, 255})
      : width(w), height(h), pixel(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}
  Rgb& at(int x, int y) {
    return pixel[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  const Rgb& at(int x, int y) const {
    return pixel[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
};

}  // namespace intarsia::tools
