#include "tools/rebuilt_shape.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace intarsia::tools {

Shape shape_of(const kernels::Reconstruction& rebuilt, std::span<const Rgb> patch_colour, bool smooth) {
  Shape shape;
  shape.x = rebuilt.point.x, shape.y = rebuilt.point.y, shape.z = rebuilt.point.z;
  shape.corner = rebuilt.corner, shape.face_label = rebuilt.patch, shape.label_colour = patch_colour;
  shape.smooth = smooth;
  return shape;
}

Lines border_lines(const kernels::Reconstruction& r, const LineStyle& style) {
  struct Side {
    Index a, b, patch;
  };
  std::vector<Side> side;
  for (std::size_t t = 0; t < r.patch.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = r.corner[3 * t + i], b = r.corner[3 * t + (i + 1) % 3];
      side.push_back({std::min(a, b), std::max(a, b), r.patch[t]});
    }
  std::sort(side.begin(), side.end(),
            [](const Side& x, const Side& y) { return std::tuple(x.a, x.b, x.patch) < std::tuple(y.a, y.b, y.patch); });
  Lines lines;
  for (std::size_t s = 0; s < side.size();) {
    std::size_t e = s + 1;
    bool border = true;
    for (; e < side.size() && side[e].a == side[s].a && side[e].b == side[s].b; ++e)
      border = border && side[e].patch != side[s].patch;
    if (border) lines.add(std::array{r.point[side[s].a], r.point[side[s].b]}, style);
    s = e;
  }
  return lines;
}

}  // namespace intarsia::tools
