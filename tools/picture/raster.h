// Which face is seen at every sample of a picture. Faces are drawn in parallel; a sample keeps the smallest
// (depth, face id), an integer, so the result depends neither on the order of the faces in time nor on threads.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/picture/camera.h"

namespace intarsia::tools {

// Memory: 8 bytes a sample, whatever the size of the mesh.
struct Frame {
  Camera camera;
  int samples = 1;                 // per pixel and side: 3 means 9 samples a pixel
  int columns = 0, rows = 0;       // of samples
  std::vector<std::uint64_t> key;  // depth * 2^32 in the high half, face id in the low half; kEmpty = background

  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};

  std::uint64_t at(int column, int row) const {
    return key[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
  }
  static Index face_of(std::uint64_t k) { return static_cast<Index>(k); }  // kNone for kEmpty
  static float depth_of(std::uint64_t k) { return static_cast<float>(k >> 32) * 0x1p-32f; }
};

// Fills frame (its memory is reused). A sample at the centre of its cell belongs to a face by the top-left rule on
// corners rounded to 1/256 of a sample: faces that share an edge leave no gap and never both claim a sample.
// Errors: bad_argument unless 1 <= samples <= 8.
void rasterise(const Work& work, const Shape& shape, const Camera& camera, int samples, Frame& frame);

}  // namespace intarsia::tools
