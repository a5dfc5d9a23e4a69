// Layouts with known surfaces for the reconstruction, and what every reconstruction must keep.
#pragma once

#include <algorithm>
#include <map>
#include <utility>

#include <doctest/doctest.h>

#include "kernels/quality/reconstruct.h"
#include "tests/kernels/layout/layout_case.h"
#include "tests/support/run_with_threads.h"

namespace intarsia::test {

// Unit sphere from an octahedron with n steps an edge: the borders of the octants are mesh edges.
inline Soup octasphere(Index n) {
  Soup s;
  std::map<std::array<int, 3>, Index> at;
  const int steps = static_cast<int>(n);
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [it, fresh] = at.try_emplace(p, s.vertex_count());
    if (fresh) add_vertex(s, Vec3(p[0], p[1], p[2]).normalized());
    return it->second;
  };
  for (const int sx : {1, -1})
    for (const int sy : {1, -1})
      for (const int sz : {1, -1}) {
        const auto corner = [&](int i, int j) { return vertex({sx * i, sy * j, sz * (steps - i - j)}); };
        const bool turned = sx * sy * sz < 0;
        const auto face = [&](Index a, Index b, Index c) { turned ? add_face(s, a, c, b) : add_face(s, a, b, c); };
        for (int i = 0; i < steps; ++i)
          for (int j = 0; i + j < steps; ++j) {
            face(corner(i, j), corner(i + 1, j), corner(i, j + 1));
            if (i + j + 1 < steps) face(corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
          }
      }
  return s;
}

inline Index octant(const MeshView& m, Index f) {
  const Vec3 c = centroid(m, f);
  return (c.x() > 0 ? 1u : 0u) + (c.y() > 0 ? 2u : 0u) + (c.z() > 0 ? 4u : 0u);
}

// The side of the cube [0, 1]^3.
inline Index cube_side(const MeshView& m, Index f) {
  const Vec3 c = centroid(m, f) - Vec3(.5, .5, .5);
  Index axis = 0;
  c.cwiseAbs().maxCoeff(&axis);
  return 2 * axis + (c[axis] > 0 ? 1 : 0);
}

inline kernels::SampledLayout sampled(const LayoutCase& c, Index loop_samples) {
  kernels::SampleOptions options;
  options.loop_samples = loop_samples;
  return kernels::sample_layout(Work(), c.mesh, trace(c), c.label, options);
}

struct AllReconstructions {
  kernels::Reconstruction triangulated, transfinite, filled;
};

inline AllReconstructions reconstruct_all(const kernels::SampledLayout& layout) {
  const Work work;
  const kernels::PatchTriangulations start = kernels::triangulate_patches(work, layout, {});
  return {kernels::reconstruct_triangulated(work, layout, start),
          kernels::reconstruct_transfinite(work, layout, start, {}),
          kernels::reconstruct_filled(work, layout, start, {})};
}

// Every step of an arc is used once by the patch on each of its sides, all other edges twice inside one patch; points
// of the samples have not moved; no NaN.
inline void check_watertight(const kernels::SampledLayout& layout, const LayoutGraph& graph,
                             const kernels::Reconstruction& r) {
  REQUIRE(r.patch.size() * 3 == r.corner.size());
  for (std::size_t i = 0; i < layout.point.size(); ++i) REQUIRE(r.point[i] == layout.point[i]);
  bool finite = true;
  for (std::size_t i = 0; i < r.point.size(); ++i) finite = finite && r.point[i].allFinite();
  CHECK(finite);
  std::map<std::array<Index, 3>, int> half;  // patch, from, to
  for (std::size_t t = 0; t < r.patch.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) ++half[{r.patch[t], r.corner[3 * t + i], r.corner[3 * t + (i + 1) % 3]}];
  for (Index a = 0; a < graph.arc_count(); ++a) {
    const auto row = layout.arc.row(a);
    for (std::size_t i = 1; i < row.size(); ++i) {
      if (graph.left[a] != kNone) --half[{graph.left[a], row[i - 1], row[i]}];
      if (graph.right[a] != kNone) --half[{graph.right[a], row[i], row[i - 1]}];
    }
  }
  Index wrong = 0;
  for (const auto& [h, count] : half) {
    const auto twin = half.find({h[0], h[2], h[1]});
    const int other = twin == half.end() ? 0 : twin->second;
    wrong += count < 0 || count > 1 || count != other;
  }
  CHECK(wrong == 0);
}

inline Real area_of(const kernels::Reconstruction& r, Index patch = kNone) {
  Real area = 0;
  for (std::size_t t = 0; t < r.patch.size(); ++t) {
    if (patch != kNone && r.patch[t] != patch) continue;
    const Vec3 a = r.point[r.corner[3 * t]], b = r.point[r.corner[3 * t + 1]], c = r.point[r.corner[3 * t + 2]];
    area += (b - a).cross(c - a).norm() / 2;
  }
  return area;
}

// Root mean square and maximum of a distance function over the triangles, at corners, middles of edges and centres.
template <class Distance>
std::pair<Real, Real> deviation(const kernels::Reconstruction& r, const Distance& distance) {
  Real sum = 0, area = 0, most = 0;
  for (std::size_t t = 0; t < r.patch.size(); ++t) {
    const Vec3 a = r.point[r.corner[3 * t]], b = r.point[r.corner[3 * t + 1]], c = r.point[r.corner[3 * t + 2]];
    const Real weight = (b - a).cross(c - a).norm() / 2;
    for (const Vec3& p : {Vec3((a + b) / 2), Vec3((b + c) / 2), Vec3((c + a) / 2), Vec3((a + b + c) / 3)}) {
      const Real d = std::abs(distance(p));
      sum += weight / 4 * d * d, most = std::max(most, d);
    }
    area += weight;
  }
  return {std::sqrt(sum / area), most};
}

inline bool same(const kernels::Reconstruction& a, const kernels::Reconstruction& b) {
  return a.point.x == b.point.x && a.point.y == b.point.y && a.point.z == b.point.z && a.corner == b.corner &&
         a.patch == b.patch && a.bridged == b.bridged && a.failed == b.failed && a.cut == b.cut;
}

}  // namespace intarsia::test
