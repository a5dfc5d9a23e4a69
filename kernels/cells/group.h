// One patch as a group of cells: its border, whether it is a disc, and what it costs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/cells/cell_complex.h"

namespace intarsia::kernels {

// Cost of a patch: integral of the squared distance to its reconstruction + w P^2 / (4 pi) + s times the salience of
// the features inside (integral of theta^2 ds). What is right for one shape is far too strong for a simpler one, so the
// weights are given relative to the errors and perimeters of the patches that refinement starts from.
struct GroupOptions {
  Real perimeter = 1;         // share of the cost of all perimeters in that of all errors, at the start
  Real salience = 0.6;        // price of one radian^2 x diagonal, in errors of all patches at the start
  Real perimeter_weight = 0;  // w, absolute; set by Grouping::weigh
  Real salience_weight = 0;   // s
  bool discs = true;          // groups must be discs, or no farther from it than what they are made from
  OutlineOptions outline{.loop_points = 64};
};

struct GroupShape {
  Real error = 0, perimeter = 0, salience = 0, area = 0;
  int euler = 0;  // of the closed group, short holes of the surface filled
  Index loops = 0;
  bool connected = false;

  // Distance from being a disc: 0 for a disc.
  int defect() const {
    const int bend = euler > 1 ? euler - 1 : 1 - euler;
    return bend + (loops > 1 ? static_cast<int>(loops) - 1 : 0);
  }
};

Real cost_of(const GroupShape& shape, const GroupOptions& options);

// Memory of one thread; grows to the size of the complex.
struct GroupScratch {
  std::vector<std::uint32_t> cell_mark, node_mark, half_mark;
  std::uint32_t stamp = 0;
  std::vector<Index> stack;
  Outline outline;
  WeightedPoints samples;
  OutlineScratch error;
  Real coarse = 0;  // as coarse_outline_error() says it
};

// One cell that is looked at as if it were in another group.
struct Override {
  Index cell = kNone, group = kNone;
};

// Border and topology of a set of cells; the outline is left in scratch.outline. Its corners are the nodes where the
// group on the other side changes (group_of_cell, moved) or where a feature turns.
// Requires: cells distinct, at least one.
GroupShape outline_of_group(const CellComplex& complex, std::span<const Index> cells,
                            std::span<const Index> group_of_cell, const Override& moved, GroupScratch& scratch);

// The error of the group whose outline stands in scratch, in two steps: a lower bound, which costs a third, and the
// error itself, for whoever still wants it. Requires: the calls before it, in this order, with the same cells.
Real least_group_error(const CellComplex& complex, std::span<const Index> cells, const GroupOptions& options,
                       GroupScratch& scratch);
Real group_error(const GroupOptions& options, GroupScratch& scratch);

// All in one; asks for the error only if the group is connected and its defect at most `most_defect`.
GroupShape shape_of_group(const CellComplex& complex, std::span<const Index> cells,
                          std::span<const Index> group_of_cell, const Override& moved, int most_defect,
                          const GroupOptions& options, GroupScratch& scratch);

}  // namespace intarsia::kernels
