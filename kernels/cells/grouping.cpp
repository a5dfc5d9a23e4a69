#include "kernels/cells/grouping.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "engine/parallel/for_each.h"
#include "engine/parallel/scratch_pool.h"

namespace intarsia::kernels {

Grouping::Grouping(const Work& work, const CellComplex& complex, std::vector<Index> group, Index groups,
                   const GroupOptions& options)
    : complex_(&complex),
      options_(options),
      group_(std::move(group)),
      cells_(groups),
      shape_(groups),
      version_(groups, 0),
      alive_(groups) {
  for (Index c = 0; c < group_.size(); ++c) cells_[group_[c]].push_back(c);
  std::vector<Index> all(groups);
  for (Index g = 0; g < groups; ++g) all[g] = g;
  refresh(work, std::move(all));
}

void Grouping::refresh(const Work& work, std::vector<Index> groups) {
  auto pool = make_scratch_pool([] { return GroupScratch(); });
  for_each_block(work, Cost::single, groups.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
    auto scratch = pool.borrow();
    for (std::size_t i = begin; i < end; ++i)
      shape_[groups[i]] = look(cells_[groups[i]], {}, std::numeric_limits<int>::max(), *scratch);
  });
}

std::vector<Index> Grouping::neighbours(Index g) const {
  std::vector<Index> found;
  for (const Index c : cells_[g])
    for (const Index h : complex_->cell_halves.row(c)) {
      const Index o = complex_->half_cell[h ^ 1];
      if (o != kNone && group_[o] != g) found.push_back(group_[o]);
    }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool Grouping::is_kept_from(Index cell, Index g) const {
  if (complex_->given.empty()) return false;
  for (const Index h : complex_->cell_halves.row(cell)) {
    const Index o = complex_->half_cell[h ^ 1];
    if (o != kNone && group_[o] == g && complex_->is_given(h)) return true;
  }
  return false;
}

bool Grouping::are_kept_apart(Index g, Index h) const {
  const Index few = cells_[g].size() <= cells_[h].size() ? g : h, many = few == g ? h : g;
  return std::any_of(cells_[few].begin(), cells_[few].end(), [&](Index c) { return is_kept_from(c, many); });
}

void Grouping::weigh(Index wanted) {
  Real round = 0;
  for (Index g = 0; g < size(); ++g)
    if (is_alive(g)) round += shape_[g].perimeter * shape_[g].perimeter / (4 * std::numbers::pi);
  const Real share = wanted > 0 ? static_cast<Real>(alive_) / static_cast<Real>(wanted) : 1;
  const Real error = total_error() * share * share;
  options_.perimeter_weight = round > 0 ? options_.perimeter * error / round : 0;
  options_.salience_weight = options_.salience * error;
}

Real Grouping::total_cost() const {
  Real sum = 0;
  for (Index g = 0; g < size(); ++g)
    if (is_alive(g)) sum += cost(g);
  return sum;
}

Real Grouping::total_cost_at(const Work& work, Index loop_points) const {
  GroupOptions finer = options_;
  finer.outline.loop_points = loop_points, finer.outline.second_points = 0;
  std::vector<Real> each(size(), 0);
  auto pool = make_scratch_pool([] { return GroupScratch(); });
  for_each_block(work, Cost::single, each.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
    auto scratch = pool.borrow();
    for (std::size_t g = begin; g < end; ++g) {
      if (cells_[g].empty()) continue;
      GroupShape shape = shape_[g];
      outline_of_group(*complex_, cells_[g], group_, {}, *scratch);
      least_group_error(*complex_, cells_[g], finer, *scratch);
      shape.error = std::max(shape.error, group_error(finer, *scratch));
      each[g] = cost_of(shape, options_);
    }
  });
  Real sum = 0;
  for (const Real cost : each) sum += cost;
  return sum;
}

Real Grouping::total_error() const {
  Real sum = 0;
  for (Index g = 0; g < size(); ++g)
    if (is_alive(g)) sum += shape_[g].error;
  return sum;
}

void Grouping::merge(const Work& work, Index into, Index from) {
  for (const Index c : cells_[from]) group_[c] = into;
  cells_[into].insert(cells_[into].end(), cells_[from].begin(), cells_[from].end());
  std::sort(cells_[into].begin(), cells_[into].end());
  cells_[from].clear();
  ++version_[into], ++version_[from];
  --alive_;
  refresh(work, {into});
}

void Grouping::place(Index cell, Index to) {
  const Index from = group_[cell];
  group_[cell] = to;
  std::erase(cells_[from], cell);
  cells_[to].insert(std::lower_bound(cells_[to].begin(), cells_[to].end(), cell), cell);
}

bool Grouping::try_move(const Work& work, Index cell, Index to, Real least) {
  const Index from = group_[cell];
  std::vector<Index> changed{from, to};  // and whoever has the cell across a border: corners may come or go
  for (const Index h : complex_->cell_halves.row(cell))
    if (const Index o = complex_->half_cell[h ^ 1]; o != kNone) changed.push_back(group_[o]);
  place(cell, to);
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  std::vector<GroupShape> old;
  Real before = 0, after = 0;
  for (const Index g : changed) old.push_back(shape_[g]), before += cost(g);
  refresh(work, changed);
  for (const Index g : changed) after += cost(g);
  if (after < before - least) {
    ++version_[from], ++version_[to];
    return true;
  }
  place(cell, from);
  for (std::size_t i = 0; i < changed.size(); ++i) shape_[changed[i]] = old[i];
  return false;
}

std::vector<Index> Grouping::spread(std::span<const Index> cell_of_face) const {
  std::vector<Index> name(size(), kNone), label(cell_of_face.size());
  Index next = 0;
  for (std::size_t f = 0; f < cell_of_face.size(); ++f) {
    Index& n = name[group_[cell_of_face[f]]];
    if (n == kNone) n = next++;
    label[f] = n;
  }
  return label;
}

}  // namespace intarsia::kernels
