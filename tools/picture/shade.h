// Light, lines and anti-aliasing: from a frame to pixels.
#pragma once

#include <vector>

#include "tools/picture/lines.h"
#include "tools/picture/normals.h"
#include "tools/picture/raster.h"

namespace intarsia::tools {

struct ShadeOptions {
  float outline = 0.45f;    // strength of the thin dark edge where the surface ends or folds away, 0 to 1
  float occlusion = 0.75f;  // strength of the darkening in hollows, 0 to 1
};

// Everything about a shape in a camera that does not depend on colours: computed once, shared by all panels of a strip.
struct Scene {
  Frame frame;
  ShadingNormals normals;
  std::vector<float> openness;      // per pixel
  std::vector<std::uint32_t> line;  // per sample, scratch of shade()
};

// Fills scene (its memory is reused).
void prepare_scene(const Work& work, const Shape& shape, const Camera& camera, int samples, Scene& scene);

// Draws the prepared shape, its colours and the lines into image with the upper left corner at (left, top); the
// background is left as it is.
// Requires: shape has the geometry that the scene was prepared with.
// Errors: bad_argument if the picture does not fit the image.
void shade(const Work& work, const Shape& shape, const Lines& lines, const ShadeOptions& options, Scene& scene,
           Image& image, int left, int top);

// One picture on white, from nothing.
Image render(const Work& work, const Shape& shape, const Lines& lines, const Camera& camera, int samples = 3,
             const ShadeOptions& options = {});

}  // namespace intarsia::tools
