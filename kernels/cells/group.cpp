#include "kernels/cells/group.h"

#include <algorithm>
#include <numbers>

namespace intarsia::kernels {
namespace {

class Walk {
 public:
  Walk(const CellComplex& c, std::span<const Index> group_of_cell, const Override& moved, GroupScratch& s)
      : c_(c), group_(group_of_cell), moved_(moved), s_(s) {
    s_.cell_mark.resize(c.cells(), 0), s_.node_mark.resize(c.nodes, 0), s_.half_mark.resize(c.next.size(), 0);
    if (++s_.stamp == 0) {
      for (auto* m : {&s_.cell_mark, &s_.node_mark, &s_.half_mark}) std::fill(m->begin(), m->end(), 0);
      s_.stamp = 1;
    }
  }

  GroupShape measure(std::span<const Index> cells) {
    GroupShape shape;
    for (const Index cell : cells) s_.cell_mark[cell] = s_.stamp, shape.area += c_.area[cell];
    shape.connected = is_connected(cells);
    Index arcs = 0, nodes = 0;
    for (const Index cell : cells) {
      shape.euler += c_.open_euler[cell];
      for (const Index h : c_.cell_halves.row(cell)) {
        const bool inner = is_in(c_.half_cell[h ^ 1]);
        if (inner && h % 2) continue;  // counted from its other side
        ++arcs;
        if (inner)
          shape.salience += c_.salience[h / 2];
        else
          shape.perimeter += c_.length[h / 2];
        for (const Index n : {c_.start[h / 2], c_.end[h / 2]})
          if (s_.node_mark[n] != s_.stamp) s_.node_mark[n] = s_.stamp, ++nodes;
      }
    }
    shape.euler += static_cast<int>(nodes) - static_cast<int>(arcs);
    s_.outline.clear();
    for (const Index cell : cells)
      for (const Index h : c_.cell_halves.row(cell))
        if (!is_in(c_.half_cell[h ^ 1]) && s_.half_mark[h] != s_.stamp) add_loop(h, shape);
    return shape;
  }

 private:
  bool is_in(Index cell) const { return cell != kNone && s_.cell_mark[cell] == s_.stamp; }
  Index outside(Index h) const {
    const Index cell = c_.half_cell[h ^ 1];
    return cell == kNone ? kNone : cell == moved_.cell ? moved_.group : group_[cell];
  }
  bool is_connected(std::span<const Index> cells) {
    s_.stack.assign(1, cells[0]);
    const std::uint32_t reached = s_.stamp - 1;  // marks of earlier calls are all smaller or equal
    s_.cell_mark[cells[0]] = reached;
    std::size_t count = 0;
    while (!s_.stack.empty()) {
      const Index cell = s_.stack.back();
      s_.stack.pop_back();
      ++count;
      for (const Index h : c_.cell_halves.row(cell)) {
        const Index o = c_.half_cell[h ^ 1];
        if (is_in(o)) s_.cell_mark[o] = reached, s_.stack.push_back(o);
      }
    }
    for (const Index cell : cells) s_.cell_mark[cell] = s_.stamp;
    return count == cells.size();
  }
  // The next half-arc around the group: turn inside it until an arc leads out.
  Index next_around(Index h) const {
    Index n = c_.next[h];
    for (std::size_t k = 0; is_in(c_.half_cell[n ^ 1]) && k < c_.next.size(); ++k) n = c_.next[n ^ 1];
    return n;
  }
  bool is_corner(Index before, Index after) const {
    return outside(before) != outside(after) || c_.corner[c_.half_start(after)];
  }
  void append(Index h) {
    const auto p = c_.arc_points(h / 2);
    auto& out = s_.outline.point;
    const bool fresh = s_.outline.piece.back() == out.size();
    if (h % 2)
      out.insert(out.end(), p.rbegin() + (fresh ? 0 : 1), p.rend());
    else
      out.insert(out.end(), p.begin() + (fresh ? 0 : 1), p.end());
    const auto in = std::span(c_.inward[h % 2]).subspan(c_.arc_offset[h / 2], p.size());
    auto& inward = s_.outline.inward;
    if (h % 2)
      inward.insert(inward.end(), in.rbegin() + (fresh ? 0 : 1), in.rend());
    else
      inward.insert(inward.end(), in.begin() + (fresh ? 0 : 1), in.end());
  }
  void add_loop(Index first, GroupShape& shape) {
    s_.stack.clear();
    Index corner = kNone;
    Real length = 0;
    bool boundary = true;
    for (Index h = first; s_.half_mark[h] != s_.stamp;) {
      s_.half_mark[h] = s_.stamp;
      s_.stack.push_back(h);
      length += c_.length[h / 2];
      boundary = boundary && c_.half_cell[h ^ 1] == kNone;
      const Index n = next_around(h);
      if (corner == kNone && is_corner(h, n)) corner = static_cast<Index>(s_.stack.size());
      h = n;
    }
    const std::size_t count = s_.stack.size();
    if (boundary && length < c_.hole_length) {  // a hole that counts as filled
      ++shape.euler;
      return;
    }
    ++shape.loops;
    const std::size_t from = corner == kNone ? 0 : corner;
    for (std::size_t k = 0; k < count; ++k) {
      const Index h = s_.stack[(from + k) % count], n = s_.stack[(from + k + 1) % count];
      append(h);
      if (k + 1 == count || is_corner(h, n)) s_.outline.end_piece();
    }
    s_.outline.end_loop();
  }

  const CellComplex& c_;
  std::span<const Index> group_;
  const Override& moved_;
  GroupScratch& s_;
};

}  // namespace

Real cost_of(const GroupShape& shape, const GroupOptions& options) {
  return shape.error + options.perimeter_weight * shape.perimeter * shape.perimeter / (4 * std::numbers::pi) +
         options.salience_weight * shape.salience;
}

GroupShape outline_of_group(const CellComplex& complex, std::span<const Index> cells,
                            std::span<const Index> group_of_cell, const Override& moved, GroupScratch& scratch) {
  return Walk(complex, group_of_cell, moved, scratch).measure(cells);
}

Real least_group_error(const CellComplex& complex, std::span<const Index> cells, const GroupOptions& options,
                       GroupScratch& scratch) {
  scratch.samples.clear();
  for (const Index cell : cells)
    for (const Index s : complex.samples.row(cell)) scratch.samples.add(complex.sample[s], complex.weight[s]);
  scratch.coarse = coarse_outline_error(scratch.outline, scratch.samples, options.outline, scratch.error);
  return std::max(scratch.coarse, Real{0});
}

Real group_error(const GroupOptions& options, GroupScratch& scratch) {
  return outline_error(scratch.outline, scratch.samples, options.outline, scratch.error, scratch.coarse);
}

GroupShape shape_of_group(const CellComplex& complex, std::span<const Index> cells,
                          std::span<const Index> group_of_cell, const Override& moved, int most_defect,
                          const GroupOptions& options, GroupScratch& scratch) {
  GroupShape shape = outline_of_group(complex, cells, group_of_cell, moved, scratch);
  if (!shape.connected || shape.defect() > most_defect) return shape;
  least_group_error(complex, cells, options, scratch);
  shape.error = group_error(options, scratch);
  return shape;
}

}  // namespace intarsia::kernels
