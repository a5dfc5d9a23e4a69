// OKLab (Ottosson 2020): a colour space in which equal steps look about equal.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "tools/picture/image.h"

namespace intarsia::tools {

using Lab = Eigen::Vector3f;  // lightness, two opponent axes

inline float to_linear(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }
inline float to_display(float v) { return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f; }

inline Lab lab_at(float lightness, float chroma, float degrees) {
  const float hue = degrees * 0.017453292519943295f;
  return {lightness, chroma * std::cos(hue), chroma * std::sin(hue)};
}

// Red, green, blue in linear light; outside [0, 1] where no display can show the colour.
inline Eigen::Vector3f linear_rgb_of(const Lab& c) {
  const float l = std::pow(c[0] + 0.3963377774f * c[1] + 0.2158037573f * c[2], 3.0f);
  const float m = std::pow(c[0] - 0.1055613458f * c[1] - 0.0638541728f * c[2], 3.0f);
  const float s = std::pow(c[0] - 0.0894841775f * c[1] - 1.2914855480f * c[2], 3.0f);
  return {4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s,
          -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s,
          -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s};
}

inline Rgb rgb_of(const Lab& c) {
  const Eigen::Vector3f linear = linear_rgb_of(c);
  const auto byte = [](float v) {
    return static_cast<std::uint8_t>(255 * std::clamp(to_display(std::max(0.0f, v)), 0.0f, 1.0f) + 0.5f);
  };
  return {byte(linear[0]), byte(linear[1]), byte(linear[2])};
}

inline Lab lab_of(Rgb c) {
  const float r = to_linear(static_cast<float>(c.r) / 255), g = to_linear(static_cast<float>(c.g) / 255),
              b = to_linear(static_cast<float>(c.b) / 255);
  const float l = std::cbrt(0.4122214708f * r + 0.5363325363f * g + 0.0514459929f * b);
  const float m = std::cbrt(0.2119034982f * r + 0.6806995451f * g + 0.1073969566f * b);
  const float s = std::cbrt(0.0883024619f * r + 0.2817188376f * g + 0.6299787005f * b);
  return {0.2104542553f * l + 0.7936177850f * m - 0.0040720468f * s,
          1.9779984951f * l - 2.4285922050f * m + 0.4505937099f * s,
          0.0259040371f * l + 0.7827717662f * m - 0.8086757660f * s};
}

}  // namespace intarsia::tools
