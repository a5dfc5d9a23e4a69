#include "kernels/cells/swap_cells.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "engine/parallel/for_each.h"
#include "engine/parallel/scratch_pool.h"

namespace intarsia::kernels {
namespace {

struct Move {
  Index cell, to;
  Index from_version, to_version;
  Real gain = 0;  // negative: the total falls; kNever if not by enough
};

struct MoveScratch {
  GroupScratch left, grown;
  std::vector<Index> rest, more;  // cells of both groups afterwards
};

constexpr Real kNever = std::numeric_limits<Real>::infinity();

// What the total changes by, if it falls by more than `least`; else kNever. Errors are asked for in steps, and no
// further once bounds from below say that nothing is won: most moves are bad ones.
Real gain_of(const Grouping& g, Index cell, Index to, Real least, MoveScratch& s) {
  const Index from = g.group_of(cell);
  if (g.cells(from).size() < 2 || g.is_kept_from(cell, to)) return kNever;
  const Override moved{cell, to};
  s.rest.assign(g.cells(from).begin(), g.cells(from).end());
  std::erase(s.rest, cell);
  GroupShape left = g.look_at_border(s.rest, moved, s.left);
  if (!left.connected || left.defect() > g.shape(from).defect()) return kNever;
  s.more.assign(g.cells(to).begin(), g.cells(to).end());
  s.more.insert(std::lower_bound(s.more.begin(), s.more.end(), cell), cell);
  GroupShape grown = g.look_at_border(s.more, moved, s.grown);
  if (!grown.connected || grown.defect() > g.shape(to).defect()) return kNever;
  const auto gain = [&] {
    return cost_of(left, g.options()) + cost_of(grown, g.options()) - g.cost(from) - g.cost(to);
  };
  if (gain() >= -least) return kNever;
  grown.error = g.least_error(s.more, s.grown);
  if (gain() >= -least) return kNever;
  left.error = g.least_error(s.rest, s.left);
  if (gain() >= -least) return kNever;
  grown.error = g.error(s.grown);
  if (gain() >= -least) return kNever;
  left.error = g.error(s.left);
  return gain();
}

// Cells beside another group, with every group they could go to; gains already known are kept.
std::vector<Move> list_moves(const Grouping& g, const std::vector<Move>& known) {
  const CellComplex& c = g.complex();
  std::vector<Move> moves;
  std::vector<Index> to;
  for (Index cell = 0; cell < c.cells(); ++cell) {
    to.clear();
    const Index own = g.group_of(cell);
    for (const Index h : c.cell_halves.row(cell)) {
      const Index o = c.half_cell[h ^ 1];
      if (o != kNone && g.group_of(o) != own) to.push_back(g.group_of(o));
    }
    std::sort(to.begin(), to.end());
    to.erase(std::unique(to.begin(), to.end()), to.end());
    for (const Index t : to) {
      const auto at =
          std::lower_bound(known.begin(), known.end(), std::pair{cell, t}, [](const Move& m, const auto& k) {
            return std::pair{m.cell, m.to} < k;
          });
      Move m{cell, t, g.version(own), g.version(t), 0};
      if (at != known.end() && at->cell == cell && at->to == t && at->from_version == m.from_version &&
          at->to_version == m.to_version)
        m.gain = at->gain;
      else
        m.from_version = kNone;  // to be looked at
      moves.push_back(m);
    }
  }
  return moves;
}

}  // namespace

SwapResult swap_cells(const Work& work, const SwapOptions& options, Grouping& g) {
  SwapResult result;
  result.before = g.total_cost();
  constexpr Real kNothing = 1e-13;  // diagonals^4: what rounding makes of patches that are rebuilt exactly
  const Real least = std::max(kNothing, options.least_gain * result.before / std::max<Index>(1, g.alive()));
  const Index most = static_cast<Index>(options.sweeps) * g.complex().cells();
  auto pool = make_scratch_pool([] { return MoveScratch(); });
  std::vector<Move> moves;
  std::vector<Index> open, best;
  std::vector<std::uint8_t> busy;
  while (result.moves < most && !work.is_late()) {
    moves = list_moves(g, moves);
    open.clear();
    for (Index i = 0; i < moves.size(); ++i)
      if (moves[i].from_version == kNone) open.push_back(i);
    for_each_block(work, Cost::single, open.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
      auto scratch = pool.borrow();
      for (std::size_t k = begin; k < end; ++k) {
        Move& m = moves[open[k]];
        m.gain = gain_of(g, m.cell, m.to, least, *scratch);
        m.from_version = g.version(g.group_of(m.cell));
      }
    });
    result.looks += static_cast<Index>(open.size());
    best.clear();
    for (Index i = 0; i < moves.size(); ++i)
      if (moves[i].gain < -least) best.push_back(i);
    std::sort(best.begin(), best.end(), [&](Index a, Index b) {
      return std::tie(moves[a].gain, moves[a].cell, moves[a].to) < std::tie(moves[b].gain, moves[b].cell, moves[b].to);
    });
    if (best.empty()) break;
    busy.assign(g.size(), 0);
    for (const Index i : best) {
      const Move m = moves[i];
      const Index from = g.group_of(m.cell);
      if (busy[from] || busy[m.to] || result.moves >= most) continue;
      if (g.try_move(work, m.cell, m.to, least / 2))
        busy[from] = busy[m.to] = 1, ++result.moves;
      else
        moves[i].gain = 0;  // the neighbours would lose more than is won
    }
  }
  result.after = g.total_cost();
  return result;
}

}  // namespace intarsia::kernels
