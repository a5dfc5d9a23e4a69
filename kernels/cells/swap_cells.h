// Refining the borders of patches: cells change sides while the reconstruction gets better.
#pragma once

#include "kernels/cells/grouping.h"

namespace intarsia::kernels {

struct SwapOptions {
  int sweeps = 5;          // times the number of cells: most moves
  Real least_gain = 1e-4;  // of the mean cost of a group: smaller gains are not worth a move
};

struct SwapResult {
  Index moves = 0, looks = 0;
  Real before = 0, after = 0;  // total cost
};

// Moves border cells to a neighbouring group where that lowers the sum of costs, best moves first; in a round every
// group takes part in one move at most. A group stays connected and no farther from a disc than it was.
SwapResult swap_cells(const Work& work, const SwapOptions& options, Grouping& grouping);

}  // namespace intarsia::kernels
