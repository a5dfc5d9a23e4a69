// Optimal triangulation of a closed polygon in space by dynamic programming (Klincsek 1980; Barequet, Sharir 1995; with
// terms between neighbouring triangles Zou, Ju, Carr 2013).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/base/lanes.h"
#include "engine/base/types.h"

namespace intarsia {

enum class PolygonMetric : std::uint8_t {
  area,              // sum of areas
  area_bend,         // sum of areas + bend_weight * sum over inner edges of length^2 (1 - cos of the bend)
  squared_dihedral,  // sum over inner edges of the squared bend, radians
  worst_dihedral,    // largest bend, radians
};

struct PolygonOptions {
  PolygonMetric metric = PolygonMetric::area_bend;
  Real bend_weight = 0.3;
  // false: the bend at a chord is measured against the triangle that is best for the part behind the chord on its own:
  // several times faster, and an upper bound of the optimum. For costs that are asked for thousands of times, and the
  // only form above 256 points.
  bool exact = true;
};

struct PolygonTriangulation {
  std::vector<std::array<Index, 3>> triangle;  // positions in the polygon, in its direction; n - 2 of them
  Real cost = 0;
  bool ok = false;  // false: no allowed triangulation (fewer than three points, or every one needs a forbidden chord)
};

// Memory that calls share; one per thread.
struct PolygonScratch {
  // Triangles behind a chord, eight side by side: the least cost of what lies behind the chord with each, and its unit
  // normal; flag 0 where there is none.
  struct alignas(64) Pack {
    Real cost[kLanes], flag[kLanes] = {}, x[kLanes] = {}, y[kLanes] = {}, z[kLanes] = {};
    Pack() { std::fill(cost, cost + kLanes, std::numeric_limits<Real>::infinity()); }
  };
  struct Candidate {
    Real cost;
    Index apex;
  };
  LaneArray real;
  std::vector<Pack> pack;
  std::vector<Index> apex, packs, pack_apex, order;
  std::vector<std::size_t> first;
  std::vector<Candidate> fresh;
  std::vector<std::uint8_t> forbidden;
};

// Of a polygon that bridges join from several loops. A tube closed by two lids has less area than the tube itself, so
// triangles with all corners on one loop are not allowed where they face another loop's middle (within 45 degrees,
// either way): flat arms of a disc with holes stay free, lids of a tube do not.
struct BridgedLoops {
  std::span<const Index> loop;                     // per point
  std::span<const Vec3> middle;                    // per loop
  std::span<const std::array<Index, 2>> no_chord;  // positions, ascending in each: further chords that are not allowed
};

// id: the same number marks copies of one point (the two sides of a bridge); empty: all differ. No chord joins two
// copies of one point, and none doubles a polygon edge (as chords between copies of the ends of a bridge would).
// Bends count only between triangles that both have an area above 1e-14 of the squared perimeter: never NaN. A bend
// across the edges of a bridge (two polygon edges with the same ids) is not counted.
// Requires: finite points; id empty or one per point.
// Ensures: ties go to the smallest apex. Time O(n^3); exact O(n^4) with a small constant: about 0.1 s for n = 200.
PolygonTriangulation triangulate_polygon(std::span<const Vec3> point, std::span<const Index> id,
                                         const PolygonOptions& options, PolygonScratch& scratch,
                                         const BridgedLoops* bridged = nullptr);

}  // namespace intarsia
