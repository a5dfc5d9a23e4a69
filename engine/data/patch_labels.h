// A partition of the faces of a mesh into patches, and what is known of each patch.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/types.h"
#include "engine/data/csr.h"
#include "engine/data/mesh.h"

namespace intarsia {

// Ids are compact and ordered by the smallest face id of each patch.
struct PatchLabels {
  std::vector<Index> patch_of_face;
  Index count = 0;

  bool operator==(const PatchLabels&) const = default;
};

// One entry per patch. Lengths and areas are in the units of the mesh.
struct PatchTable {
  std::vector<Index> faces;  // number of faces
  std::vector<Real> area;
  Vec3Array normal_sum;             // sum of area times unit normal; E(patch) = 2 (area - |normal_sum|)
  std::vector<Real> perimeter;      // all border edges, those on the boundary of the surface included
  std::vector<std::int32_t> euler;  // V - E + F of the closed patch, each vertex counted once, filled holes as faces
  std::vector<Index> loops;         // border loops, filled holes not counted
  std::vector<Index> filled_holes;  // short boundary loops of the surface that lie inside the patch

  Index count() const { return static_cast<Index>(faces.size()); }
  // A patch that touches itself at a vertex is no disc: it has Euler characteristic below 1.
  bool is_disc(Index p) const { return euler[p] == 1 && loops[p] == 1; }
};

// patch -> its faces, ascending. Counting sort: linear, no comparison.
inline Csr faces_of_patches(const PatchLabels& labels) {
  Csr csr;
  csr.offset.assign(std::size_t{labels.count} + 1, 0);
  csr.item.resize(labels.patch_of_face.size());
  for (const Index p : labels.patch_of_face) ++csr.offset[p + 1];
  for (Index p = 0; p < labels.count; ++p) csr.offset[p + 1] += csr.offset[p];
  std::vector<Index> cursor(csr.offset.begin(), csr.offset.end() - 1);
  for (Index f = 0; f < labels.patch_of_face.size(); ++f) csr.item[cursor[labels.patch_of_face[f]]++] = f;
  return csr;
}

}  // namespace intarsia
