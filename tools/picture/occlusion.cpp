#include "tools/picture/occlusion.h"

#include <cmath>

#include "engine/parallel/for_each.h"

namespace intarsia::tools {
namespace {

constexpr int kTaps = 16;
constexpr int kPattern = 4;  // the rotation of the taps repeats every 4 x 4 pixels and is averaged out over as many

struct Tap {
  float x, y;  // in units of the radius
};

// Points of a spiral with radii that favour the neighbourhood of the pixel, in 16 rotations.
std::vector<Tap> taps_of_pattern() {
  std::vector<Tap> taps;
  for (int p = 0; p < kPattern * kPattern; ++p)
    for (int i = 0; i < kTaps; ++i) {
      const double r = std::pow((i + 0.5 + (p * 7 % 16 - 7.5) / 16.0) / kTaps, 1.5);
      const double angle = 2.399963229728653 * i + 6.283185307179586 * (p * 5 % 16) / 16.0;
      taps.push_back({static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle))});
    }
  return taps;
}

}  // namespace

void open_sky(const Work& work, const Shape& shape, const Frame& frame, float radius, std::vector<float>& openness) {
  const int width = frame.camera.width, height = frame.camera.height, middle = frame.samples / 2;
  const auto at = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  openness.assign(pixels, 1.0f);
  std::vector<float> depth(pixels), raw(pixels, 1.0f);  // depth in pixels, growing away from the viewer
  const float to_pixels = static_cast<float>(1 / frame.camera.depth_per_pixel()), kFar = 1e9f;
  const auto rows = static_cast<std::size_t>(height);
  for_each(work, Cost::heavy, rows, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      const std::uint64_t key = frame.at(x * frame.samples + middle, y * frame.samples + middle);
      depth[at(x, y)] = key == Frame::kEmpty ? kFar : Frame::depth_of(key) * to_pixels;
    }
  });

  static const std::vector<Tap> taps = taps_of_pattern();
  const float reach = radius * static_cast<float>(std::max(width, height));
  for_each(work, Cost::single, (rows + 7) / 8, [&](std::size_t band) {
    for (std::size_t row = 8 * band; row < std::min(rows, 8 * band + 8); ++row)
      for (int x = 0, y = static_cast<int>(row); x < width; ++x) {
        const float z = depth[at(x, y)];
        if (z == kFar) continue;
        const Index f = Frame::face_of(frame.at(x * frame.samples + middle, y * frame.samples + middle));
        const Index* v = shape.corner.data() + 3 * std::size_t{f};
        const Vec3 p0 = shape.point(v[0]);
        Vec3 n = (shape.point(v[1]) - p0).cross(shape.point(v[2]) - p0);
        const Real length = n.norm();
        if (!(length > 0)) continue;
        n /= n.dot(frame.camera.toward) < 0 ? -length : length;
        const auto nx = static_cast<float>(n.dot(frame.camera.right)), ny = static_cast<float>(-n.dot(frame.camera.up)),
                   nz = static_cast<float>(n.dot(frame.camera.toward));
        const Tap* tap = taps.data() + kTaps * ((y % kPattern) * kPattern + x % kPattern);
        float sum = 0;
        for (int i = 0; i < kTaps; ++i) {
          const int qx = x + static_cast<int>(std::lround(tap[i].x * reach)),
                    qy = y + static_cast<int>(std::lround(tap[i].y * reach));
          if (qx < 0 || qy < 0 || qx >= width || qy >= height) continue;
          const float zq = depth[at(qx, qy)];
          if (zq == kFar) continue;
          const float vx = static_cast<float>(qx - x), vy = static_cast<float>(qy - y), vz = z - zq;
          const float square = vx * vx + vy * vy + vz * vz;
          if (square < 0.5f) continue;
          const float distance = std::sqrt(square), rise = (nx * vx + ny * vy + nz * vz) / distance - 0.08f;
          const float fade = 1 - square / (4 * reach * reach);  // things far in front do not darken
          if (rise > 0 && fade > 0) sum += rise * fade;
        }
        raw[at(x, y)] = std::max(0.0f, 1 - 2.8f * sum / kTaps);
      }
  });

  for_each(work, Cost::single, (rows + 7) / 8, [&](std::size_t band) {
    for (std::size_t row = 8 * band; row < std::min(rows, 8 * band + 8); ++row)
      for (int x = 0, y = static_cast<int>(row); x < width; ++x) {
        const float z = depth[at(x, y)];
        if (z == kFar) continue;
        float sum = 0, weight = 0;
        for (int dy = -2; dy < 2; ++dy)
          for (int dx = -2; dx < 2; ++dx) {
            const int qx = x + dx, qy = y + dy;
            if (qx < 0 || qy < 0 || qx >= width || qy >= height) continue;
            if (std::abs(depth[at(qx, qy)] - z) > 6) continue;
            sum += raw[at(qx, qy)], weight += 1;
          }
        openness[at(x, y)] = weight > 0 ? sum / weight : raw[at(x, y)];
      }
  });
}

}  // namespace intarsia::tools
