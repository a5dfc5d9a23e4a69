// What each patch is: size, shape, and whether it is a disc.
#pragma once

#include <span>

#include "engine/data/patch_labels.h"
#include "kernels/patches/patch_surface.h"

namespace intarsia::kernels {

// The share of face f in the Euler characteristic of its closed region: a face, the edges and the vertices of which it
// is the smallest face of the region. same(g) tells whether face g belongs to the region of f.
// Sums over the faces of a region give V - E + F with every vertex counted once.
template <class Same>
int euler_share(const MeshView& mesh, Index f, const Same& same) {
  int share = 1;
  for (int i = 0; i < 3; ++i) {
    const Index g = mesh.other_face(mesh.face_edge[3 * f + i], f);
    if (g == kNone || f < g || !same(g)) --share;
    bool first = true;
    for (const Index s : mesh.vertex_faces.row(mesh.corner[3 * f + i])) {
      if (s >= f) break;
      if (same(s)) {
        first = false;
        break;
      }
    }
    if (first) ++share;
  }
  return share;
}

// Face f has two neighbours of its region: are these still joined through faces around the corner between them when f
// is taken away? same(g) as above.
template <class Same>
bool stays_joined(const MeshView& mesh, Index f, const Same& same) {
  int out = 0;  // the edge without a neighbour lies opposite the corner in question
  while (out < 2) {
    const Index g = mesh.other_face(mesh.face_edge[3 * f + out], f);
    if (g == kNone || !same(g)) break;
    ++out;
  }
  const Index v = mesh.corner[3 * f + out];
  const Index target = mesh.other_face(mesh.face_edge[3 * f + (out + 2) % 3], f);
  Index from = f, g = mesh.other_face(mesh.face_edge[3 * f + (out + 1) % 3], f);
  while (g != kNone && g != f && same(g)) {
    if (g == target) return true;
    Index next = kNone;
    for (int i = 0; i < 3; ++i) {
      const Index o = mesh.other_face(mesh.face_edge[3 * g + i], g);
      if (mesh.corner[3 * g + i] != v && o != from) next = o;
    }
    from = g, g = next;
  }
  return false;
}

// Requires: labels.patch_of_face.size() == face_count().
// A short boundary loop counts as filled in the patch that holds all of its edges.
PatchTable measure_patches(const Work& work, const PatchSurface& surface, const PatchLabels& labels);

// Euler characteristics alone, short holes filled.
std::vector<std::int32_t> euler_of_patches(const Work& work, const PatchSurface& surface, const PatchLabels& labels);

// The patch that holds all edges of a short boundary loop, or kNone.
Index patch_of_hole(const PatchSurface& surface, Index hole, std::span<const Index> patch_of_face);

}  // namespace intarsia::kernels
