// Light, lines and anti-aliasing: from a frame to pixels.
#pragma once

#include <vector>

#include "tools/picture/lines.h"
#include "tools/picture/raster.h"

namespace intarsia::tools {

struct ShadeOptions {
  float outline = 0.45f;   // strength of the thin dark edge where the surface ends or folds away, 0 to 1
  float occlusion = 0.8f;  // strength of the darkening in hollows, 0 to 1
};

// Light that reaches a sample, in steps small against those of a display.
struct Light {
  std::uint16_t diffuse = 0;  // factor of the colour, in 1/32768
  std::uint8_t gloss = 0;     // added white, linear, in 1/512
  std::uint8_t edge = 0;      // low 7 bits: darkness of the outline, in 1/127; high bit: the back of the face is seen
  bool operator==(const Light&) const = default;
};

// Everything about a shape in a camera that does not depend on colours: computed once, shared by all panels of a strip.
struct Scene {
  Frame frame;
  std::vector<Light> light;         // per sample
  std::vector<std::uint32_t> line;  // per sample, scratch of shade()
};

// Fills scene (its memory is reused). Memory: 16 bytes a sample.
void prepare_scene(const Work& work, const Shape& shape, const Camera& camera, int samples, const ShadeOptions& options,
                   Scene& scene);

// Draws the prepared shape, its colours and the lines into image with the upper left corner at (left, top); the
// background is left as it is.
// Requires: shape has the geometry that the scene was prepared with.
// Errors: bad_argument if the picture does not fit the image.
void shade(const Work& work, const Shape& shape, const Lines& lines, Scene& scene, Image& image, int left, int top);

// One picture on white, from nothing.
Image render(const Work& work, const Shape& shape, const Lines& lines, const Camera& camera, int samples = 3,
             const ShadeOptions& options = {});

}  // namespace intarsia::tools
