// Curves drawn by hand on a flat grid, for tests of what is done with curves.
#pragma once

#include <vector>

#include "engine/data/feature_curves.h"
#include "tests/support/surface.h"

namespace intarsia::test {

// The vertex of the normalised surface nearest to input position p.
inline Index vertex_near(const TestSurface& s, const Vec3& p) {
  Index best = 0;
  for (Index v = 0; v < s.mesh.vertex_count(); ++v)
    if ((s.input_point(v) - p).norm() < (s.input_point(best) - p).norm()) best = v;
  return best;
}

// One curve through mesh vertices. Points are new, except that `shared` (a point id) may take the place of the first.
inline void draw(FeatureCurves& c, const std::vector<Index>& vertices, CurveKind kind = CurveKind::ridge,
                 bool concave = false, Real turn = 1, Index shared = kNone) {
  if (c.net.curve.offset.empty()) c.net.curve.offset.push_back(0);
  std::vector<Index> row;
  for (Index v : vertices) {
    if (row.empty() && shared != kNone) {
      row.push_back(shared);
      continue;
    }
    const Index p = c.point_count();
    c.resize_points(p + 1);
    c.net.point[p] = SurfacePoint::at_vertex(v);
    c.normal.set(p, Vec3(0, 0, 1)), c.across.set(p, Vec3(0, 1, 0));
    c.kd[p] = c.kmax[p] = 3, c.kmin[p] = 1, c.extremality[p] = 2, c.sharpness[p] = 1.5, c.radius[p] = 0.01;
    c.turn()[p] = turn;
    row.push_back(p);
  }
  c.add_curve(row, kind, concave);
}

// Vertices of the unit-cell grid `plane(n, n)` scaled by n, from (x0, y) to (x1, y).
inline std::vector<Index> grid_row(const TestSurface& s, int x0, int x1, int y, Real n) {
  std::vector<Index> v;
  for (int x = x0; x <= x1; ++x) v.push_back(vertex_near(s, Vec3(x / n, y / n, 0)));
  return v;
}

}  // namespace intarsia::test
