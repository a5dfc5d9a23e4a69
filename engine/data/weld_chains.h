// Chains of items joined end to end.
#pragma once

#include <span>
#include <vector>

#include "engine/data/csr.h"

namespace intarsia {

// Chain c has two ends: 2c is its front, 2c + 1 its back.
inline Index chain_of_end(Index end) { return end / 2; }
inline Index opposite_end(Index end) { return end ^ 1u; }

struct WeldedChains {
  Csr chain;                  // a closed chain repeats its first item
  std::vector<Index> source;  // welded chain -> the smallest chain that went into it
};

// mate[end] is the end it is joined to, or kNone. Two joined ends that hold the same item share it; otherwise both stay
// and become neighbours. A chain may be joined to itself (mate[2c] == 2c + 1), which closes it.
// Requires: mate is an involution without fixed points; no empty chain.
// Ensures: results ordered by source; a chain without mates is unchanged.
WeldedChains weld_chains(CsrView chain, std::span<const Index> mate);

}  // namespace intarsia
