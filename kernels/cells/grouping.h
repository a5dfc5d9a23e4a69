// All patches as groups of cells, with their shapes kept up to date under moves and merges.
#pragma once

#include <vector>

#include "kernels/cells/group.h"

namespace intarsia::kernels {

class Grouping {
 public:
  // group: of every cell, below `groups`; every group has a cell.
  Grouping(const Work& work, const CellComplex& complex, std::vector<Index> group, Index groups,
           const GroupOptions& options);

  const CellComplex& complex() const { return *complex_; }
  const GroupOptions& options() const { return options_; }
  Index size() const { return static_cast<Index>(cells_.size()); }
  Index alive() const { return alive_; }
  bool is_alive(Index g) const { return !cells_[g].empty(); }
  Index group_of(Index cell) const { return group_[cell]; }
  std::span<const Index> group_of_cell() const { return group_; }
  std::span<const Index> cells(Index g) const { return cells_[g]; }
  const GroupShape& shape(Index g) const { return shape_[g]; }
  Real cost(Index g) const { return cost_of(shape_[g], options_); }
  Index version(Index g) const { return version_[g]; }  // counts changes of its set of cells
  std::vector<Index> neighbours(Index g) const;         // groups across its border, ascending
  // Does a curve that the user gave run between them?
  bool is_kept_from(Index cell, Index g) const;
  bool are_kept_apart(Index g, Index h) const;
  // Fixes the weights of perimeters and features by the shapes as they are now. A number of patches other than `wanted`
  // is allowed for: errors fall with the square of the number.
  void weigh(Index wanted);
  Real total_cost() const;
  // The same where every error is the worse of what it is and what it would be with so many points around a patch: some
  // borders look good only by where their samples happen to fall.
  Real total_cost_at(const Work& work, Index loop_points) const;
  Real total_error() const;

  // What a set of cells would be. Safe from several threads with a scratch each.
  GroupShape look(std::span<const Index> cells, const Override& moved, int most_defect, GroupScratch& scratch) const {
    return shape_of_group(*complex_, cells, group_, moved, most_defect, options_, scratch);
  }
  // The same in three steps, each dearer than the one before: the shape without its error, a bound below the error, and
  // the error. One scratch through all three.
  GroupShape look_at_border(std::span<const Index> cells, const Override& moved, GroupScratch& scratch) const {
    return outline_of_group(*complex_, cells, group_, moved, scratch);
  }
  Real least_error(std::span<const Index> cells, GroupScratch& scratch) const {
    return least_group_error(*complex_, cells, options_, scratch);
  }
  Real error(GroupScratch& scratch) const { return group_error(options_, scratch); }

  void merge(const Work& work, Index into, Index from);
  // Moves a cell if the total cost, corners of the groups around included, falls by more than `least`; otherwise
  // nothing changes. Returns whether it moved.
  bool try_move(const Work& work, Index cell, Index to, Real least);

  // Patch of every face, from its cell; compact ids in order of the smallest face.
  std::vector<Index> spread(std::span<const Index> cell_of_face) const;

 private:
  void place(Index cell, Index to);
  void refresh(const Work& work, std::vector<Index> groups);

  const CellComplex* complex_;
  GroupOptions options_;
  std::vector<Index> group_;
  std::vector<std::vector<Index>> cells_;
  std::vector<GroupShape> shape_;
  std::vector<Index> version_;
  Index alive_ = 0;
};

}  // namespace intarsia::kernels
