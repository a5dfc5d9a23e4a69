#include "kernels/surface/orient_triangles.h"

#include <algorithm>

namespace intarsia::kernels {
namespace {

constexpr std::uint8_t kUnseen = 2;

// Joins the sides of edges with exactly two triangles. Returns, per side, whether both run in the same direction.
std::vector<std::uint8_t> join_sides(const Work& work, const std::vector<Side>& side, Orientation& out) {
  std::vector<std::uint8_t> clash(side.size(), 0);
  for_each_edge(work, side, [&](std::size_t begin, std::size_t end) {
    if (end - begin > 2) out.cut_crowded.push_back(side[begin].triangle());
    if (end - begin != 2 || side[begin].triangle() == side[begin + 1].triangle()) return;
    const Side &p = side[begin], &q = side[begin + 1];
    out.partner[p.at] = q.at, out.partner[q.at] = p.at;
    clash[p.at] = clash[q.at] = p.forward == q.forward ? 1 : 0;
  });
  return clash;
}

}  // namespace

Orientation orient_triangles(const Work& work, const std::vector<Side>& side, std::span<const Real> area) {
  Orientation out;
  out.partner.assign(side.size(), kNone);
  const std::vector<std::uint8_t> clash = join_sides(work, side, out);
  out.turned.assign(area.size(), kUnseen);
  std::vector<Index> piece;
  for (Index first = 0; first < area.size(); ++first) {
    if (out.turned[first] != kUnseen) continue;
    piece.assign(1, first);
    out.turned[first] = 0;
    Real kept = 0, turned = 0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Index t = piece[i];
      (out.turned[t] ? turned : kept) += area[t];
      for (Index s = 3 * t; s < 3 * t + 3; ++s) {
        if (out.partner[s] == kNone) continue;
        const Index u = out.partner[s] / 3;
        const std::uint8_t wanted = out.turned[t] ^ clash[s];
        if (out.turned[u] == kUnseen) {
          out.turned[u] = wanted;
          piece.push_back(u);
        } else if (out.turned[u] != wanted) {
          out.partner[out.partner[s]] = kNone, out.partner[s] = kNone;
          out.cut_unorientable.push_back(std::min(t, u));
        }
      }
      if ((i & 0xfff) == 0) work.check();
    }
    if (turned > kept)
      for (const Index t : piece) out.turned[t] ^= 1;
    if ((first & 0xfff) == 0) work.check();
  }
  for (auto* cut : {&out.cut_crowded, &out.cut_unorientable}) std::sort(cut->begin(), cut->end());
  return out;
}

}  // namespace intarsia::kernels
