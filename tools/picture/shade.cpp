#include "tools/picture/shade.h"

#include <array>
#include <cmath>

#include "engine/parallel/for_each.h"
#include "tools/picture/light.h"
#include "tools/picture/occlusion.h"

namespace intarsia::tools {
namespace {

constexpr float kDiffuseStep = 1.0f / 32768, kGlossStep = 1.0f / 512, kEdgeStep = 1.0f / 127;
constexpr std::uint8_t kBack = 128;

using Colour = std::array<float, 3>;  // display values in [0, 255]

float to_linear(std::uint8_t v) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < 256; ++i) {
      const double s = static_cast<double>(i) / 255;
      t[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
    return t;
  }();
  return table[v];
}

// Linear light to display values, with a soft shoulder: colours in full light keep their hue instead of clipping.
float to_display(float linear) {
  constexpr int kSteps = 4096;
  constexpr double kTop = 2;
  static const std::array<float, kSteps + 1> table = [] {
    std::array<float, kSteps + 1> t{};
    for (std::size_t i = 0; i <= kSteps; ++i) {
      const double x = kTop * static_cast<double>(i) / kSteps, v = x < 0.8 ? x : 1 - 0.2 * std::exp(-(x - 0.8) * 5);
      t[i] = static_cast<float>(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055));
    }
    return t;
  }();
  constexpr auto scale = static_cast<float>(kSteps / kTop);
  return table[static_cast<std::size_t>(std::clamp(linear * scale + 0.5f, 0.0f, static_cast<float>(kSteps)))];
}

Colour shaded(Rgb rgb, const Light& light) {
  float base[3] = {to_linear(rgb.r), to_linear(rgb.g), to_linear(rgb.b)};
  if (light.edge & kBack) {  // dull, so that a look into an open surface is understood
    const float grey = 0.12f * (base[0] + base[1] + base[2]) / 3;
    for (float& b : base) b = 0.55f * b + grey;
  }
  const float diffuse = static_cast<float>(light.diffuse) * kDiffuseStep,
              gloss = static_cast<float>(light.gloss) * kGlossStep;
  const float keep = 1 - static_cast<float>(light.edge & 127) * kEdgeStep;
  Colour c;
  for (std::size_t i = 0; i < 3; ++i) c[i] = keep * to_display(base[i] * diffuse + gloss);
  return c;
}

// How much deeper the picture gets right beside the sample, as the strength of an outline in [0, 1].
float fold(const Frame& frame, int column, int row, std::uint64_t key, int reach, float to_pixels) {
  float jump = 0;
  const float depth = Frame::depth_of(key);
  const auto look = [&](int c, int r) {
    if (c < 0 || r < 0 || c >= frame.columns || r >= frame.rows) return;
    const std::uint64_t other = frame.at(c, r);
    jump = std::max(jump, other == Frame::kEmpty ? 100.0f : (Frame::depth_of(other) - depth) * to_pixels);
  };
  look(column - reach, row), look(column + reach, row), look(column, row - reach), look(column, row + reach);
  return std::clamp((jump - 8) / 16, 0.0f, 1.0f);
}

Light packed(const Brightness& b) {
  Light light;
  light.diffuse = static_cast<std::uint16_t>(std::clamp(b.diffuse / static_cast<Real>(kDiffuseStep), 0.0, 65535.0));
  light.gloss = static_cast<std::uint8_t>(std::clamp(b.gloss / static_cast<Real>(kGlossStep), 0.0, 255.0));
  light.edge = b.back ? kBack : 0;
  return light;
}

std::size_t sample_index(const Frame& frame, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.columns) + static_cast<std::size_t>(column);
}

// Calls body(y) for every row of pixels, a few rows a task.
template <class Body>
void for_each_row(const Work& work, int height, const Body& body) {
  constexpr int kBand = 4;
  for_each(work, Cost::single, static_cast<std::size_t>((height + kBand - 1) / kBand), [&](std::size_t band) {
    const int begin = kBand * static_cast<int>(band), end = std::min(height, begin + kBand);
    for (int y = begin; y < end; ++y) body(y);
  });
}

// Light of the samples of one pixel: computed once per face, in the middle of the samples that show it.
void light_pixel(const Lamp& lamp, float open, int x, int y, Scene& scene) {
  const Frame& frame = scene.frame;
  struct Part {
    Index face;
    int count, columns, rows;
    Light light;
  };
  std::array<Part, 64> part;
  std::size_t parts = 0;
  const int n = frame.samples;
  const auto find = [&](Index f) {
    std::size_t k = 0;
    while (k < parts && part[k].face != f) ++k;
    return k;
  };
  for (int r = y * n; r < y * n + n; ++r)
    for (int c = x * n; c < x * n + n; ++c) {
      const std::uint64_t key = frame.at(c, r);
      if (key == Frame::kEmpty) continue;
      const std::size_t k = find(Frame::face_of(key));
      if (k == parts) part[parts++] = {Frame::face_of(key), 0, 0, 0, {}};
      ++part[k].count, part[k].columns += c, part[k].rows += r;
    }
  for (std::size_t k = 0; k < parts; ++k) {
    const Real per = 1 / (static_cast<Real>(part[k].count) * n), half = 0.5 / n;
    part[k].light = packed(lamp.at(part[k].face, part[k].columns * per + half, part[k].rows * per + half, open));
  }
  for (int r = y * n; r < y * n + n; ++r)
    for (int c = x * n; c < x * n + n; ++c) {
      const std::uint64_t key = frame.at(c, r);
      if (key != Frame::kEmpty) scene.light[sample_index(frame, c, r)] = part[find(Frame::face_of(key))].light;
    }
}

}  // namespace

void prepare_scene(const Work& work, const Shape& shape, const Camera& camera, int samples, const ShadeOptions& options,
                   Scene& scene) {
  rasterise(work, shape, camera, samples, scene.frame);
  const ShadingNormals normals = shading_normals(work, shape);
  std::vector<float> openness;
  open_sky(work, shape, scene.frame, 0.08f, openness);
  const Frame& frame = scene.frame;
  scene.light.resize(frame.key.size());
  const Lamp lamp(shape, normals, frame.camera);
  const auto to_pixels = static_cast<float>(1 / frame.camera.depth_per_pixel());
  const int n = samples, reach = std::max(1, n - 1);
  for_each_row(work, camera.height, [&](int y) {
    for (int x = 0; x < camera.width; ++x) {
      const float sky =
          openness[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) + static_cast<std::size_t>(x)];
      light_pixel(lamp, 1 - options.occlusion * (1 - sky), x, y, scene);
    }
    for (int r = y * n; r < y * n + n; ++r)
      for (int c = 0; c < frame.columns; ++c) {
        const std::uint64_t key = frame.at(c, r);
        if (key == Frame::kEmpty) continue;
        const float edge = options.outline * fold(frame, c, r, key, reach, to_pixels);
        scene.light[sample_index(frame, c, r)].edge |= static_cast<std::uint8_t>(std::clamp(edge, 0.0f, 1.0f) * 127);
      }
  });
}

void shade(const Work& work, const Shape& shape, const Lines& lines, Scene& scene, Image& image, int left, int top) {
  const Frame& frame = scene.frame;
  const int width = frame.camera.width, height = frame.camera.height, n = frame.samples;
  if (left < 0 || top < 0 || left + width > image.width || top + height > image.height)
    throw Error(ErrorCode::bad_argument, "the picture does not fit the image");
  draw_lines(work, frame, lines, scene.line);
  for_each_row(work, height, [&](int y) {
    Rgb last_rgb;
    Light last_light;
    Colour last = shaded(last_rgb, last_light);
    for (int x = 0; x < width; ++x) {
      Colour sum = {0, 0, 0};
      int background = 0;
      for (int r = y * n; r < y * n + n; ++r)
        for (int c = x * n; c < x * n + n; ++c) {
          const std::size_t s = sample_index(frame, c, r);
          if (scene.line[s] != 0) {
            const Rgb rgb = lines.style[scene.line[s] - 1].colour;
            sum[0] += rgb.r, sum[1] += rgb.g, sum[2] += rgb.b;
          } else if (frame.key[s] == Frame::kEmpty) {
            ++background;
          } else {
            const Rgb rgb = shape.colour_of(Frame::face_of(frame.key[s]));
            if (!(rgb == last_rgb && scene.light[s] == last_light)) {
              last_rgb = rgb, last_light = scene.light[s];
              last = shaded(rgb, last_light);
            }
            for (std::size_t i = 0; i < 3; ++i) sum[i] += last[i];
          }
        }
      if (background == n * n) continue;
      Rgb& pixel = image.at(left + x, top + y);
      const auto byte = [&](std::size_t i, std::uint8_t behind) {
        const float v = (sum[i] + static_cast<float>(background * behind)) / static_cast<float>(n * n);
        return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 255.0f) + 0.5f);
      };
      pixel = {byte(0, pixel.r), byte(1, pixel.g), byte(2, pixel.b)};
    }
  });
}

Image render(const Work& work, const Shape& shape, const Lines& lines, const Camera& camera, int samples,
             const ShadeOptions& options) {
  Image image(camera.width, camera.height);
  Scene scene;
  prepare_scene(work, shape, camera, samples, options, scene);
  shade(work, shape, lines, scene, image, 0, 0);
  return image;
}

}  // namespace intarsia::tools
