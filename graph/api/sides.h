// One direction of a distance in the caller's units.
#pragma once

#include "graph/api/intarsia.h"
#include "kernels/quality/surface_distance.h"
#include "kernels/surface/normalise_box.h"

namespace intarsia::call {

DistanceSide side_of(const kernels::OneSided& side, const kernels::BoxTransform& box);
// Errors: bad_argument.
std::uint64_t checked_samples(std::uint64_t samples);

}  // namespace intarsia::call
