// Merging patches by what their reconstruction would lose: over-segment, then merge by true error.
#pragma once

#include <string>

#include "kernels/cells/grouping.h"

namespace intarsia::kernels {

// Merges the pair whose union costs least more than its parts, until `target` groups are left. With options().discs
// only into discs (or unions nearer to one than their worse part). Order: (cost, smaller group, larger group).
// Returns empty, or why the target was not reached.
std::string merge_groups(const Work& work, Index target, Grouping& grouping);

}  // namespace intarsia::kernels
