// The inner loops of polygon triangulation: what the triangles over one chord look like, and what lies behind them,
// eight at a time.
#pragma once

#include "engine/base/lanes.h"
#include "engine/space/triangulate_polygon.h"

namespace intarsia::polygon {

// A normal with its weight: (0, 0, 0, 0) for a triangle without area and for what lies outside the polygon.
struct Facing {
  Real flag = 0, x = 0, y = 0, z = 0;
  Real dot(const Facing& o) const { return x * o.x + y * o.y + z * o.z; }
};

// What is known of the chords of one point, by their other end: the best triangle behind each and its cost.
struct Row {
  const Real *cost, *weight, *flag, *x, *y, *z;
};

// What the triangles (i, m, k) of one chord look like, for every apex m.
struct Fan {
  Real *area, *flag, *x, *y, *z, *left, *right, *sum;
};

// left, right: cost behind the chords (i, m), (m, k) if the best triangle behind each is taken, with its bend.
// sum: that of a triangulation, so no less than the optimum. Whole lanes are written around from .. to.
void open_fan(const Real* px, const Real* py, const Real* pz, const Real* ends, Real least_area, const Row& l,
              const Row& r, Index from, Index to, const Fan& out);

// The place of the least number in from .. to, the first of equals; `to` if none is finite. Requires: x aligned for Lanes,
// whole lanes that may be read around from .. to.
Index first_least(const Real* x, Index from, Index to);

// Least of `least` and cost + weight * (flags - cosine) over the candidates of a chord. They ascend by cost and a bend
// adds at least nothing, so the scan ends where the cost alone is no better.
Real least_with_bend(const PolygonScratch::Pack* pack, Index packs, Real weight, const Real* front, Real least);

// A lower bound of the squared angle between two normals for every candidate of a pack: the first three terms of
// acos(c)^2 = 2 u + u^2 / 3 + 4 u^3 / 45 + ..., u = 1 - c, all positive.
void least_angles2(const PolygonScratch::Pack& c, const Real* front, Real* out);

}  // namespace intarsia::polygon
