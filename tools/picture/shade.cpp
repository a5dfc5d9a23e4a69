#include "tools/picture/shade.h"

#include <array>
#include <cmath>

#include "engine/parallel/for_each.h"
#include "tools/picture/occlusion.h"

namespace intarsia::tools {
namespace {

using Colour = Eigen::Vector3f;  // linear light, or display values in [0, 255] where said so

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

float to_display(float linear) {  // 0..1 -> 0..255
  constexpr int kSteps = 4096;
  static const std::array<float, kSteps + 1> table = [] {
    std::array<float, kSteps + 1> t{};
    for (std::size_t i = 0; i <= kSteps; ++i) {
      const double v = static_cast<double>(i) / kSteps;
      t[i] = static_cast<float>(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055));
    }
    return t;
  }();
  return table[static_cast<std::size_t>(std::clamp(linear, 0.0f, 1.0f) * kSteps + 0.5f)];
}

// Soft shoulder: colours under full light keep their hue instead of clipping.
float shoulder(float v) { return v < 0.8f ? v : 1 - 0.2f * std::exp(-(v - 0.8f) * 5); }

Colour display(const Colour& linear) {
  return {to_display(shoulder(linear.x())), to_display(shoulder(linear.y())), to_display(shoulder(linear.z()))};
}

// Lights are fixed to the viewer: x right, y up, z towards the viewer.
Colour lit(Rgb rgb, const Vec3& normal, float openness, bool back) {
  static const Vec3 key = Vec3(-0.42, 0.66, 0.62).normalized(), fill = Vec3(0.85, 0.15, 0.50).normalized();
  static const Vec3 half = (key + Vec3(0, 0, 1)).normalized();
  const Real k = std::max(0.0, (normal.dot(key) + 0.12) / 1.12), f = std::max(0.0, (normal.dot(fill) + 0.25) / 1.25);
  const Real sky = 0.5 + 0.5 * normal.y(), graze = 1 - normal.z();
  const auto open = static_cast<Real>(openness);
  const Real diffuse = 0.74 * k * (0.45 + 0.55 * open) + open * (0.20 * f + 0.17 * sky + 0.10);
  const Real rim = 0.16 * graze * graze * graze * sky * open;
  const Real shine = 0.07 * std::pow(std::max(0.0, normal.dot(half)), 36.0) * open;
  Colour base(to_linear(rgb.r), to_linear(rgb.g), to_linear(rgb.b));
  if (back) base = 0.55f * base + Colour::Constant(0.12f * base.sum() / 3);
  return base * static_cast<float>(1.08 * diffuse) + Colour::Constant(static_cast<float>(rim + (back ? 0 : shine)));
}

class Shader {
 public:
  Shader(const Shape& shape, const Scene& scene) : shape_(shape), scene_(scene) {}

  // Display colour of face f around the sample position (column, row).
  Colour operator()(Index f, Real column, Real row, float openness) const {
    const Camera& camera = scene_.frame.camera;
    const Index* v = shape_.corner.data() + 3 * std::size_t{f};
    const Vec3 p[3] = {shape_.point(v[0]), shape_.point(v[1]), shape_.point(v[2])};
    Vec3 n = (p[1] - p[0]).cross(p[2] - p[0]);
    const Real length = n.norm();
    n = length > 0 ? Vec3(n / length) : camera.toward;
    const Vec3 face_normal = n;
    if (shape_.smooth && (shape_.vertex_normal.size() > 0 || !scene_.normals.empty())) {
      Real w[3];
      weights(p, column, row, w);
      Vec3 sum = Vec3::Zero();
      for (int i = 0; i < 3; ++i) {
        Vec3 m = shape_.vertex_normal.size() > 0 ? shape_.vertex_normal[v[i]] : scene_.normals[v[i]];
        const Real size = m.norm(), along = m.dot(face_normal);
        // Across a crease the normal of the vertex belongs to neither side.
        m = along > 0.82 * size ? Vec3(m / size) : face_normal;
        sum += w[i] * m;
      }
      if (sum.norm() > 0) n = sum.normalized();
    }
    const Vec3 eye = camera.toward - (camera.perspective / camera.radius) * (p[0] - camera.centre);
    const bool back = face_normal.dot(eye) < 0;
    if (back) n = -n;
    Vec3 local(camera.right.dot(n), camera.up.dot(n), camera.toward.dot(n));
    if (local.z() < 0.02) local.z() = 0.02, local.normalize();
    return display(lit(shape_.colour_of(f), local, openness, back));
  }

 private:
  void weights(const Vec3 p[3], Real column, Real row, Real w[3]) const {
    const Frame& frame = scene_.frame;
    Real x[3], y[3];
    for (int i = 0; i < 3; ++i) {
      const Projected q = frame.camera.project(p[i]);
      x[i] = q.x * frame.samples - column, y[i] = q.y * frame.samples - row;
    }
    Real sum = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      w[i] = x[j] * y[k] - x[k] * y[j];
    }
    const Real area = w[0] + w[1] + w[2];
    for (int i = 0; i < 3; ++i) {
      w[i] = std::abs(area) > 1e-12 ? std::clamp(w[i] / area, Real(0), Real(1)) : Real(1) / 3;
      sum += w[i];
    }
    for (int i = 0; i < 3; ++i) w[i] /= sum;
  }

  const Shape& shape_;
  const Scene& scene_;
};

// How much deeper the picture gets right beside the sample, as the strength of an outline in [0, 1].
float fold(const Frame& frame, int column, int row, float depth, int reach, float to_pixels) {
  float jump = 0;
  const auto look = [&](int c, int r) {
    if (c < 0 || r < 0 || c >= frame.columns || r >= frame.rows) return;
    const std::uint64_t key = frame.at(c, r);
    jump = std::max(jump, key == Frame::kEmpty ? 100.0f : (Frame::depth_of(key) - depth) * to_pixels);
  };
  look(column - reach, row), look(column + reach, row), look(column, row - reach), look(column, row + reach);
  return std::clamp((jump - 8) / 16, 0.0f, 1.0f);
}

}  // namespace

void prepare_scene(const Work& work, const Shape& shape, const Camera& camera, int samples, Scene& scene) {
  scene.normals = shading_normals(work, shape);
  rasterise(work, shape, camera, samples, scene.frame);
  open_sky(work, shape, scene.frame, 0.06f, scene.openness);
}

void shade(const Work& work, const Shape& shape, const Lines& lines, const ShadeOptions& options, Scene& scene,
           Image& image, int left, int top) {
  const Frame& frame = scene.frame;
  const int width = frame.camera.width, height = frame.camera.height, n = frame.samples;
  if (left < 0 || top < 0 || left + width > image.width || top + height > image.height)
    throw Error(ErrorCode::bad_argument, "the picture does not fit the image");
  draw_lines(work, frame, lines, scene.line);
  const Shader shader(shape, scene);
  const auto to_pixels = static_cast<float>(1 / frame.camera.depth_per_pixel());
  const int reach = std::max(1, n - 1);
  struct Part {  // samples of a pixel that show the same face
    Index face;
    int count;
    Real column, row;
    Colour colour;
  };
  for_each(work, Cost::single, (static_cast<std::size_t>(height) + 3) / 4, [&](std::size_t band) {
    std::array<Part, 64> part;
    const int end = std::min(height, 4 * static_cast<int>(band) + 4);
    for (int y = 4 * static_cast<int>(band); y < end; ++y)
      for (int x = 0; x < width; ++x) {
        std::size_t parts = 0;
        bool touched = false;
        for (int r = y * n; r < y * n + n; ++r)
          for (int c = x * n; c < x * n + n; ++c) {
            const std::size_t s =
                static_cast<std::size_t>(r) * static_cast<std::size_t>(frame.columns) + static_cast<std::size_t>(c);
            touched = touched || scene.line[s] != 0;
            const Index f = Frame::face_of(frame.key[s]);
            if (frame.key[s] == Frame::kEmpty || scene.line[s] != 0) continue;
            std::size_t k = 0;
            while (k < parts && part[k].face != f) ++k;
            if (k == parts) part[parts++] = {f, 0, 0, 0, Colour::Zero()};
            part[k].count += 1, part[k].column += c + 0.5, part[k].row += r + 0.5;
          }
        if (parts == 0 && !touched) continue;
        const float open =
            scene.openness[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
        for (std::size_t k = 0; k < parts; ++k)
          part[k].colour = shader(part[k].face, part[k].column / part[k].count, part[k].row / part[k].count,
                                  1 - options.occlusion * (1 - open));
        Rgb& pixel = image.at(left + x, top + y);
        const Colour background(pixel.r, pixel.g, pixel.b);
        Colour sum = Colour::Zero();
        for (int r = y * n; r < y * n + n; ++r)
          for (int c = x * n; c < x * n + n; ++c) {
            const std::size_t s =
                static_cast<std::size_t>(r) * static_cast<std::size_t>(frame.columns) + static_cast<std::size_t>(c);
            if (scene.line[s] != 0) {
              const Rgb rgb = lines.style[scene.line[s] - 1].colour;
              sum += Colour(rgb.r, rgb.g, rgb.b);
            } else if (frame.key[s] == Frame::kEmpty) {
              sum += background;
            } else {
              const Index f = Frame::face_of(frame.key[s]);
              std::size_t k = 0;
              while (part[k].face != f) ++k;
              const float edge = fold(frame, c, r, Frame::depth_of(frame.key[s]), reach, to_pixels);
              sum += part[k].colour * (1 - options.outline * edge);
            }
          }
        sum /= static_cast<float>(n * n);
        const auto byte = [](float v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 255.0f) + 0.5f); };
        pixel = {byte(sum.x()), byte(sum.y()), byte(sum.z())};
      }
  });
}

Image render(const Work& work, const Shape& shape, const Lines& lines, const Camera& camera, int samples,
             const ShadeOptions& options) {
  Image image(camera.width, camera.height);
  Scene scene;
  prepare_scene(work, shape, camera, samples, scene);
  shade(work, shape, lines, options, scene, image, 0, 0);
  return image;
}

}  // namespace intarsia::tools
