// How much of one set of curves lies near another.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "graph/artefacts.h"

namespace intarsia::test {

using Segments = std::vector<std::pair<Vec3, Vec3>>;

// Arcs of features (ridge, valley, sharp) in the input's units.
inline Segments feature_arcs(const graph::Surface& surface, const graph::Layout& layout) {
  Segments out;
  const auto at = [&](Index v) {
    const SurfacePoint p = layout.refined.origin[v];
    MeshView given = surface.mesh;
    if (surface.given.size() > 0) given.x = surface.given.x, given.y = surface.given.y, given.z = surface.given.z;
    return surface.box.to_input(position(given, p));
  };
  for (Index a = 0; a < layout.graph.arc_count(); ++a) {
    if (layout.graph.kind[a] > CurveKind::sharp) continue;
    const auto row = layout.graph.arc.row(a);
    for (std::size_t i = 1; i < row.size(); ++i) out.emplace_back(at(row[i - 1]), at(row[i]));
  }
  return out;
}

inline Real length_of(const Segments& s) {
  Real length = 0;
  for (const auto& [a, b] : s) length += (b - a).norm();
  return length;
}

// Share of the length of `of` that is within `distance` of `near`; sampled in steps of distance / 4.
inline Real covered(const Segments& of, const Segments& near, Real distance) {
  Real all = 0, good = 0;
  for (const auto& [a, b] : of) {
    const int n = std::max(1, static_cast<int>((b - a).norm() / (distance / 4)));
    for (int i = 0; i < n; ++i) {
      const Vec3 p = a + (i + 0.5) / n * (b - a);
      const Real share = (b - a).norm() / n;
      all += share;
      const bool is_near = std::any_of(near.begin(), near.end(), [&](const auto& s) {
        const Vec3 d = s.second - s.first;
        const Real t = d.squaredNorm() > 0 ? std::clamp((p - s.first).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0;
        return (p - s.first - t * d).squaredNorm() <= distance * distance;
      });
      if (is_near) good += share;
    }
  }
  return all > 0 ? good / all : 1;
}

}  // namespace intarsia::test
