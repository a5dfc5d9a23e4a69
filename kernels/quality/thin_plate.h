// The smooth surface through the border of a patch: least integral of the squared Laplacian, or of its difference from
// the curvature that the border has.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/types.h"

namespace intarsia::kernels {

// Fixed points beyond the border that carry its tangents. Strips between consecutive positions that both have one
// close the rings of the border points between them.
struct GhostRow {
  std::vector<Vec3> outward;      // per border position: away from the patch, one border step long
  std::vector<std::uint8_t> has;  // per border position
};

struct PlateOptions {
  int flat_rounds = 1;  // thin plates: the first with uniform weights, others with cotangents of the last shape
  int bent_rounds = 1;  // then the Laplacian is not to vanish, but to be the curvature found at the border, continued
                        // harmonically (Schneider, Kobbelt 2000): parts of spheres and cylinders are kept as they are
};

// One shape per round that could be solved: positions of the inner points.
// point: the border first, then inner points; triangle: consistently oriented.
// next: per border position the next one on its loop.
// Ensures: finite positions. Cotangent weights are kept within 0.02 .. 50, areas above a thousandth of their mean.
std::vector<std::vector<Vec3>> solve_thin_plate(std::span<const Vec3> point, Index border,
                                                std::span<const std::array<Index, 3>> triangle,
                                                std::span<const Index> next, const GhostRow& ghost,
                                                const PlateOptions& options);

}  // namespace intarsia::kernels
