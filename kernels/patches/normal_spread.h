// How far the normals of a region spread: the quantities behind the pi/2 rule.
#pragma once

#include <span>

#include "engine/base/types.h"

namespace intarsia::kernels {

struct WeightedNormal {
  Vec3 normal;  // unit, or zero: then it is left out
  Real area;
};

// Largest angle between two normals, radians. At most 2000 normals: exact. More: at least as large as between the
// extreme normals of 256 directions, short by 1 to 2 degrees at most. Angles below `enough` may be returned as any
// value below it.
Real max_pair_angle(std::span<const WeightedNormal> normals, Real enough);

// Spread along the principal direction of the normals about their mean, after `trim` of the area is left out at each
// end, radians; pi where the mean means nothing (a closed or tubular region).
Real trimmed_spread(std::span<const WeightedNormal> normals, Real trim);

}  // namespace intarsia::kernels
