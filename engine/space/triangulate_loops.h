// Triangulating what several closed loops bound: a disc with holes, a tube. Loops are joined by bridges into one
// polygon (Zou, Ju, Carr 2013 treat the general problem; layouts are nearly all discs). Which bridges: those with the
// least cost of the cheap form (PolygonOptions::exact false); then that one polygon as asked for.
#pragma once

#include "engine/space/triangulate_polygon.h"

namespace intarsia {

struct LoopsOptions {
  PolygonOptions polygon;
  int bridges = 4;        // shortest bridges tried for every loop beyond the first, no two with a common end
  int combinations = 64;  // of bridges, at most
};

struct LoopsTriangulation {
  std::vector<std::array<Index, 3>> triangle;  // positions in the concatenated loops
  Real cost = 0;
  bool ok = false;
  bool bridged = false;
};

// offset: loop l has points offset[l] .. offset[l + 1] - 1; all loops run with the surface on their left, so that holes
// run against the outer loop. The loop that bridges start from is the longest one (ties: first).
// id as in triangulate_polygon: points with the same id (a loop that touches itself) are never joined; empty: all
// differ. Tubes stay tubes: see BridgedLoops.
// Requires: at least one loop, none empty.
// Ensures: every polygon edge is used once; triangles that a bridge made have its two ends in them.
LoopsTriangulation triangulate_loops(std::span<const Vec3> point, std::span<const Index> offset,
                                     std::span<const Index> id, const LoopsOptions& options, PolygonScratch& scratch);

}  // namespace intarsia
