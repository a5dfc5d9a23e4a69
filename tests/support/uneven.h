// Meshes with edges of very different lengths, of the same surface.
#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "engine/base/random.h"
#include "tests/support/shapes.h"

namespace intarsia::test {

// Halves the longest edges of the triangles that are chosen(triangle), and then of their parts, `passes` times in all.
// No triangle is halved twice in a pass.
template <class Chosen>
Soup halved_where(Soup s, int passes, const Chosen& chosen) {
  std::vector<Index> origin(s.face_count());
  for (Index t = 0; t < s.face_count(); ++t) origin[t] = t;
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<std::tuple<Index, Index, Index>> sides;  // smaller vertex, larger vertex, side
    const auto end = [&](Index c) { return s.corner[c % 3 == 2 ? c - 2 : c + 1]; };
    for (Index c = 0; c < s.corner.size(); ++c)
      sides.emplace_back(std::min(s.corner[c], end(c)), std::max(s.corner[c], end(c)), c);
    std::sort(sides.begin(), sides.end());
    std::vector<Index> across(s.corner.size(), kNone);
    for (std::size_t i = 1; i < sides.size(); ++i)
      if (std::get<0>(sides[i]) == std::get<0>(sides[i - 1]) && std::get<1>(sides[i]) == std::get<1>(sides[i - 1]))
        across[std::get<2>(sides[i])] = std::get<2>(sides[i - 1]),
        across[std::get<2>(sides[i - 1])] = std::get<2>(sides[i]);
    const Index triangles = s.face_count();
    std::vector<std::uint8_t> halved(triangles, 0);
    for (Index t = 0; t < triangles; ++t) {
      if (!chosen(origin[t]) || halved[t]) continue;
      Index c = 3 * t;
      const auto length = [&](Index k) { return (test::point(s, s.corner[k]) - test::point(s, end(k))).norm(); };
      for (Index k = 3 * t + 1; k < 3 * t + 3; ++k)
        if (length(k) > length(c)) c = k;
      const Index p = across[c];
      if (p != kNone && halved[p / 3]) continue;
      const Index m = add_vertex(s, 0.5 * (test::point(s, s.corner[c]) + test::point(s, end(c))));
      const auto halve = [&](Index side) {
        const Index b = side % 3 == 2 ? side - 2 : side + 1, third = b % 3 == 2 ? b - 2 : b + 1;
        const Index vb = s.corner[b], vc = s.corner[third];
        s.corner[b] = m;
        add_face(s, m, vb, vc);
        origin.push_back(origin[side / 3]);
        halved[side / 3] = 1;
      };
      halve(c);
      if (p != kNone) halve(p);
    }
  }
  return s;
}

// The same of a random share of the triangles: small ones between large ones everywhere.
inline Soup halved_at_random(const Soup& s, Real share, int passes, std::uint64_t seed) {
  const Random random(seed, 0);
  return halved_where(s, passes, [&](Index t) { return random.uniform(t) < share; });
}

}  // namespace intarsia::test
