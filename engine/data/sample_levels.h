// Coarse samples of a surface: connected clusters of neighbouring vertices, level by level (about 4, 16, 64, ..
// vertices), and the discs that are measured and fitted through them where six rings see nothing but a plane.
//
// A scale is one byte. 1 .. 6 is a ring count. A code above 6 is a disc: the part of the surface around a vertex that
// is connected inside a ball of radius disc_radius(code) = 0.057 * 1.5^(code - 16) diagonals. Codes are absolute, so
// meshes of different density use the same discs for the same shape.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/base/types.h"
#include "engine/data/csr.h"
#include "engine/data/mesh.h"

namespace intarsia {

inline constexpr int kRings = 6;      // paper: m
inline constexpr int kFirstDisc = 7;  // radius 0.0015
inline constexpr int kLastDisc = 17;  // radius 0.0855
inline constexpr int kDiscs = kLastDisc - kFirstDisc + 1;

inline bool is_disc(std::uint8_t code) { return code >= kFirstDisc; }
inline Real disc_radius(int code) { return 0.057 * std::pow(1.5, code - 16); }

struct SampleLevel {
  std::vector<Index> parent;  // item of the finer level (level 0: vertex) -> cluster of this level
  Csr member;                 // cluster -> items of the finer level
  Csr neighbours;             // cluster -> clusters that share an edge of the mesh
  Vec3Array centre;           // area-weighted mean of the vertices
  std::vector<Real> area;     // a third of each face to each of its corners
  std::vector<Real> spacing;  // smoothed distance between neighbouring vertices below this cluster

  Index size() const { return static_cast<Index>(area.size()); }
};

struct SampleLevels {
  std::vector<SampleLevel> level;  // level[0]: about 4 vertices a cluster. Empty where no vertex needs a disc.

  // Spacing of the samples of level l (0-based) where vertices are `spacing` apart.
  static Real cell(std::size_t l, Real spacing) { return spacing * static_cast<Real>(std::size_t{2} << l); }
  // The level whose samples serve a disc of this radius: the coarsest with at least 3.2 cells in the radius.
  std::size_t level_for(Real radius, Real spacing) const {
    std::size_t l = 0;
    while (l + 1 < level.size() && 3.2 * cell(l + 1, spacing) <= radius) ++l;
    return l;
  }
};

}  // namespace intarsia
