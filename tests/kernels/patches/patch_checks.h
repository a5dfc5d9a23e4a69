// Reference implementations that the patch tests compare with.
#pragma once

#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "engine/data/patch_labels.h"
#include "kernels/patches/patch_surface.h"
#include "tests/kernels/patches/identity_refinement.h"

namespace intarsia::test {

inline kernels::PatchSurface surface_of(const TestRefinement& t, Real hole_length = 0.05) {
  return kernels::make_patch_surface(Work(), t.refined, t.normal, t.mean_edge, hole_length);
}

// One patch per call of the sequential flood fill, in order of the smallest face.
template <class Joined>
PatchLabels sequential_flood(const MeshView& m, const Joined& joined) {
  PatchLabels labels;
  labels.patch_of_face.assign(m.face_count(), kNone);
  for (Index start = 0; start < m.face_count(); ++start) {
    if (labels.patch_of_face[start] != kNone) continue;
    std::vector<Index> stack{start};
    labels.patch_of_face[start] = labels.count;
    while (!stack.empty()) {
      const Index f = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Index e = m.face_edge[3 * f + i], g = m.other_face(e, f);
        if (g == kNone || labels.patch_of_face[g] != kNone || !joined(e)) continue;
        labels.patch_of_face[g] = labels.count;
        stack.push_back(g);
      }
    }
    ++labels.count;
  }
  return labels;
}

inline bool is_connected(const MeshView& m, const PatchLabels& labels) {
  const auto& p = labels.patch_of_face;
  const auto pieces = sequential_flood(m, [&](Index e) { return p[m.edge_f0[e]] == p[m.edge_f1[e]]; });
  return pieces.count == labels.count && pieces.patch_of_face == p;
}

// V - E + F of the closed patch, by sets.
inline int euler_by_sets(const MeshView& m, const PatchLabels& labels, Index patch) {
  std::set<Index> vertices, edges;
  int faces = 0;
  for (Index f = 0; f < m.face_count(); ++f) {
    if (labels.patch_of_face[f] != patch) continue;
    ++faces;
    for (int i = 0; i < 3; ++i) vertices.insert(m.corner[3 * f + i]), edges.insert(m.face_edge[3 * f + i]);
  }
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + faces;
}

// No edge is on the network.
inline bool nowhere(const MeshView&, Index) { return false; }

}  // namespace intarsia::test
