// The numbers of view.html as compact bytes (tools/view/decode.js reads them): whole numbers in groups of seven bits,
// positions as steps of a grid over the surface's box, each told by its difference from the one before.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "engine/data/mesh.h"

namespace intarsia::tools {

class PageBytes {
 public:
  void whole(std::uint32_t value) {
    while (value > 127) bytes_ += static_cast<char>((value & 127) | 128), value >>= 7;
    bytes_ += static_cast<char>(value);
  }
  void integer(std::int32_t value) {
    whole(value < 0 ? 2 * static_cast<std::uint32_t>(-(value + 1)) + 1 : 2 * static_cast<std::uint32_t>(value));
  }
  void real(Real value) {
    const float f = static_cast<float>(value);
    char raw[4];
    std::memcpy(raw, &f, 4);
    bytes_.append(raw, 4);
  }
  void byte(std::uint8_t value) { bytes_ += static_cast<char>(value); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

inline constexpr std::int32_t kPageSteps = (1 << 20) - 1;  // along the longest side

// Normalised positions to grid steps.
struct PageGrid {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  Real step = 1;

  std::int32_t steps(const Vec3& p, int axis) const {
    return static_cast<std::int32_t>(std::lround((p[axis] - low[axis]) / step));
  }
};

// The grid of a page, over its refined mesh.
PageGrid grid_of(const MeshView& mesh);

// Successive points.
class PagePath {
 public:
  PagePath(const PageGrid& grid, PageBytes& to) : grid_(grid), to_(to) {}
  void point(const Vec3& p) {
    for (int i = 0; i < 3; ++i) {
      const std::int32_t now = grid_.steps(p, i);
      to_.integer(now - last_[i]);
      last_[i] = now;
    }
  }

 private:
  const PageGrid& grid_;
  PageBytes& to_;
  std::int32_t last_[3] = {0, 0, 0};
};

std::string base64(const std::string& bytes);
// Empty where the text is not base64.
std::string bytes_of_base64(const std::string& text);

}  // namespace intarsia::tools
