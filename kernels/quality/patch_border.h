// The loops of one patch of a sampled layout, and gluing what was made of every patch into one surface.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "kernels/quality/reconstruct.h"

namespace intarsia::kernels {

struct PatchBorder {
  std::vector<Vec3> point;
  std::vector<Index> id;        // points of the layout; a patch that touches itself has some of them twice
  std::vector<Index> offset;    // loop -> first position; one more than loops
  std::vector<Index> half_arc;  // loop by loop
  std::vector<Index> side;      // half-arc -> first position; one more than half-arcs

  Index size() const { return static_cast<Index>(id.size()); }
  Index loops() const { return static_cast<Index>(offset.size() - 1); }
  Real length() const;
};

PatchBorder border_of(const SampledLayout& layout, Index patch);

// Corners below the size of the border are positions in it, those above inner points.
struct PatchMesh {
  std::vector<Vec3> inner;
  std::vector<std::array<Index, 3>> triangle;
  bool bridged = false, failed = false;
};

// The optimal triangulation of a border; failed and empty if there is none.
PatchMesh triangulate_border(const PatchBorder& border, const LoopsOptions& options, PolygonScratch& scratch);

using MakePatch = std::function<PatchMesh(Index patch, const PatchBorder& border, PolygonScratch& scratch)>;

// Calls `make` for every patch that has loops, side by side, the longest borders first.
Reconstruction rebuild(const Work& work, const SampledLayout& layout, const MakePatch& make);

}  // namespace intarsia::kernels
