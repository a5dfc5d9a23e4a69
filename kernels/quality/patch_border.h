// The loops of one patch of a sampled layout, and gluing what was made of every patch into one surface.
#pragma once

#include <array>
#include <functional>
#include <span>
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
};

PatchBorder border_of(const SampledLayout& layout, Index patch);

using Triangles = std::vector<std::array<Index, 3>>;

// Corners below the size of the border are positions in it, those above inner points.
struct PatchMesh {
  std::vector<Vec3> inner;
  Triangles triangle;
  bool failed = false, cut = false;
};

// body(patch, its border) for every patch, side by side, the longest borders first.
void for_each_patch(const Work& work, const SampledLayout& layout,
                    const std::function<void(Index patch, PatchBorder&& border)>& body);

using MakePatch = std::function<PatchMesh(Index patch, const PatchBorder& border)>;

// Calls `make` for every patch that has loops, side by side, the longest borders first. Patches without triangles have
// failed.
Reconstruction rebuild(const Work& work, const SampledLayout& layout, const MakePatch& make);

// Whether every point is within `reach` of the triangles. start: points of them, one for each, that are likely near;
// or empty.
bool stays_near(std::span<const Vec3> shape, std::span<const Vec3> start, std::span<const Vec3> point,
                const Triangles& triangle, Real reach);

Real diagonal_of(std::span<const Vec3> point);

}  // namespace intarsia::kernels
