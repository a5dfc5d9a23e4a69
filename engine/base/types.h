// Scalar and index types used everywhere.
#pragma once

#include <cstdint>
#include <limits>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace intarsia {

using Real = double;
using Index = std::uint32_t;
using Vec3 = Eigen::Vector3d;

inline constexpr Index kNone = std::numeric_limits<Index>::max();  // "no such element"

}  // namespace intarsia
