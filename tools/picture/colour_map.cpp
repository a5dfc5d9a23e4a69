#include "tools/picture/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "engine/parallel/for_each.h"
#include "tools/picture/font.h"
#include "tools/picture/oklab.h"

namespace intarsia::tools {
namespace {

constexpr int kColours = 256;
const TextStyle kNumber = {11.0f, 0.13f, {70, 74, 84}};
const TextStyle kLabel = {12.0f, 0.13f, {70, 74, 84}};

// The path through OKLab: lightness, chroma, hue in degrees.
constexpr float kStop[][3] = {{0.955f, 0.020f, 110}, {0.885f, 0.115f, 112}, {0.770f, 0.130f, 150},
                              {0.640f, 0.098f, 200}, {0.510f, 0.118f, 252}, {0.390f, 0.150f, 290},
                              {0.285f, 0.140f, 312}};
constexpr int kStops = static_cast<int>(std::size(kStop));

// Catmull and Rom's curve through the stops (1974).
Lab on_path(float t) {
  const auto stop = [](int i) {
    i = std::clamp(i, 0, kStops - 1);
    return lab_at(kStop[i][0], kStop[i][1], kStop[i][2]);
  };
  const float x = t * static_cast<float>(kStops - 1);
  const int i = std::clamp(static_cast<int>(x), 0, kStops - 2);
  const float u = x - static_cast<float>(i);
  const Lab a = stop(i - 1), b = stop(i), c = stop(i + 1), d = stop(i + 2);
  return b + 0.5f * u * (c - a + u * (2 * a - 5 * b + 4 * c - d + u * (3 * (b - c) + d - a)));
}

// Even steps of OKLab distance along the path; chroma given up where no display shows it.
std::array<Rgb, kColours> make_map() {
  constexpr int kFine = 4096;
  std::vector<float> length(kFine + 1, 0);
  for (int i = 1; i <= kFine; ++i)
    length[static_cast<std::size_t>(i)] =
        length[static_cast<std::size_t>(i - 1)] +
        (on_path(static_cast<float>(i) / kFine) - on_path(static_cast<float>(i - 1) / kFine)).norm();
  std::array<Rgb, kColours> map;
  for (int k = 0; k < kColours; ++k) {
    const float wanted = length.back() * static_cast<float>(k) / (kColours - 1);
    const auto at = std::lower_bound(length.begin(), length.end(), wanted) - length.begin();
    Lab lab = on_path(static_cast<float>(at) / kFine);
    for (int tries = 0; tries < 40; ++tries) {
      const Eigen::Vector3f rgb = linear_rgb_of(lab);
      if (rgb.minCoeff() >= 0 && rgb.maxCoeff() <= 1) break;
      lab[1] *= 0.97f, lab[2] *= 0.97f;
    }
    map[static_cast<std::size_t>(k)] = rgb_of(lab);
  }
  return map;
}

// The largest of 1, 2 and 5 times a power of ten that is not above x.
Real round_step(Real x) {
  const Real power = std::pow(10.0, std::floor(std::log10(x)));
  for (const Real factor : {5.0, 2.0})
    if (factor * power <= x * (1 + 1e-9)) return factor * power;
  return power;
}

std::string text_of(Real value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

}  // namespace

Rgb map_colour(Real t) {
  static const std::array<Rgb, kColours> map = make_map();
  const Real at = std::isfinite(t) ? std::clamp(t, 0.0, 1.0) * (kColours - 1) : 0;
  return map[static_cast<std::size_t>(at + 0.5)];
}

ColourScale scale_for(std::span<const Real> value, std::span<const Real> weight, std::string label, Real beyond) {
  std::vector<std::size_t> order(value.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return value[a] != value[b] ? value[a] > value[b] : a < b; });
  Real total = weight.empty() ? static_cast<Real>(value.size()) : 0;
  for (const Real w : weight) total += w;
  Real passed = 0, level = 0;
  for (const std::size_t i : order) {
    level = value[i];
    passed += weight.empty() ? 1 : weight[i];
    if (passed > beyond * total) break;
  }
  ColourScale scale;
  scale.label = std::move(label);
  if (level > 0) {
    const Real step = round_step(level / 4);
    scale.top = step * std::ceil(level / step * (1 - 1e-9));
  }
  scale.open = !order.empty() && value[order.front()] > scale.top * (1 + 1e-9);
  return scale;
}

std::vector<Rgb> colours_of(const Work& work, std::span<const Real> value, const ColourScale& scale) {
  std::vector<Rgb> colour(value.size());
  for_each(work, Cost::light, value.size(), [&](std::size_t i) { colour[i] = map_colour(value[i] / scale.top); });
  return colour;
}

void draw_scale_bar(Image& image, int left, int top, int width, const ColourScale& scale) {
  constexpr int kBar = 13, kText = 18;  // pixels
  const int bar_top = top + kText;
  const auto put = [&](int x, int y, Rgb colour) {
    if (image.contains(x, y)) image.at(x, y) = colour;
  };
  constexpr Rgb kFrame = {150, 153, 160};
  for (int x = 0; x < width; ++x)
    for (int y = -1; y <= kBar; ++y) {
      const bool frame = y < 0 || y == kBar || x == 0 || x == width - 1;
      put(left + x, bar_top + y, frame ? kFrame : map_colour(x / Real(width - 1)));
    }
  const float middle = static_cast<float>(left) + 0.5f * static_cast<float>(width);
  draw_text(image, std::round(middle - 0.5f * text_width(scale.label, kLabel)), static_cast<float>(top + kText - 7),
            scale.label, kLabel);
  // As many round numbers as have room.
  Real step = round_step(scale.top / 4);
  const auto widest = [&] { return text_width(text_of(scale.top - step), kNumber) + 14; };
  while (step < scale.top && widest() > width * step / scale.top) step = round_step(step * 2.5);
  step = std::min(step, scale.top);
  const int count = static_cast<int>(std::floor(scale.top / step * (1 + 1e-9)));
  for (int i = 0; i <= count; ++i) {
    const Real value = i * step;
    const int x = left + static_cast<int>(std::lround(value / scale.top * (width - 1)));
    for (int y = 0; y < 5; ++y) put(x, bar_top + kBar + y, kFrame);
    const bool last = scale.top - value < 1e-9 * scale.top;
    const std::string text = (last && scale.open ? "> " : "") + text_of(value);
    draw_text(image, std::round(static_cast<float>(x) - 0.5f * text_width(text, kNumber)),
              static_cast<float>(bar_top + kBar + 20), text, kNumber);
  }
}

Image with_scale_bar(const Image& picture, const ColourScale& scale) {
  Image out(picture.width, picture.height + kScaleBarHeight);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) out.at(x, y) = picture.at(x, y);
  const int width = std::min(420, picture.width - 60);
  draw_scale_bar(out, (picture.width - width) / 2, picture.height + 2, width, scale);
  return out;
}

Image beside(const Image& a, const Image& b) {
  Image out(a.width + b.width, std::max(a.height, b.height));
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) out.at(x, y) = a.at(x, y);
  for (int y = 0; y < b.height; ++y)
    for (int x = 0; x < b.width; ++x) out.at(a.width + x, y) = b.at(x, y);
  return out;
}

}  // namespace intarsia::tools
