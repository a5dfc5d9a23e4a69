#include "engine/data/weld_chains.h"

#include <cstdint>

namespace intarsia {

WeldedChains weld_chains(CsrView chain, std::span<const Index> mate) {
  WeldedChains out;
  out.chain.offset.push_back(0);
  std::vector<std::uint8_t> done(chain.rows(), 0);
  for (Index c = 0; c < chain.rows(); ++c) {
    if (done[c]) continue;
    // Back from the front of c to where the path starts; a cycle comes back to c itself.
    Index start = 2 * c;
    for (Index m = mate[start]; m != kNone && opposite_end(m) != 2 * c; m = mate[start]) start = opposite_end(m);
    const bool cycle = mate[start] != kNone;
    if (cycle) start = 2 * c;
    const std::size_t first = out.chain.item.size();
    Index end = start;
    do {
      const Index k = chain_of_end(end);
      done[k] = 1;
      const auto row = chain.row(k);
      const bool forward = end == 2 * k;
      for (std::size_t i = 0; i < row.size(); ++i) {
        const Index item = forward ? row[i] : row[row.size() - 1 - i];
        const bool shared = i == 0 && out.chain.item.size() > first && out.chain.item.back() == item;
        if (!shared) out.chain.item.push_back(item);
      }
      end = mate[opposite_end(end)];
    } while (end != kNone && end != start);
    if (cycle && out.chain.item.back() != out.chain.item[first]) out.chain.item.push_back(out.chain.item[first]);
    out.chain.offset.push_back(static_cast<Index>(out.chain.item.size()));
    out.source.push_back(c);
  }
  return out;
}

}  // namespace intarsia
