#include "kernels/surface/soup_sides.h"

#include <algorithm>

#include "engine/parallel/for_each.h"
#include "engine/parallel/sort.h"

namespace intarsia::kernels {

std::vector<Side> sorted_sides(const Work& work, std::span<const Index> corner) {
  std::vector<Side> side(corner.size());
  for_each(work, Cost::light, corner.size() / 3, [&](std::size_t t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = corner[3 * t + i], b = corner[3 * t + (i + 1) % 3];
      side[3 * t + i] = {std::min(a, b), std::max(a, b), static_cast<Index>(3 * t + i), a < b};
    }
  });
  sort_total(work, side.begin(), side.end());
  return side;
}

}  // namespace intarsia::kernels
