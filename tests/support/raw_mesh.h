// A soup as a connected mesh just as it stands: same numbers, same units. For tests of kernels that do not need the
// canonical order.
#pragma once

#include "engine/parallel/connect_mesh.h"
#include "tests/support/shapes.h"

namespace intarsia::test {

inline Mesh raw_mesh(const Soup& soup) {
  Mesh m;
  m.x = soup.x, m.y = soup.y, m.z = soup.z;
  m.corner = soup.corner;
  connect_mesh(Work{}, m);
  return m;
}

// The vertex nearest to p; the smallest id among equals.
inline Index nearest_vertex(const MeshView& m, const Vec3& p) {
  Index best = 0;
  for (Index v = 1; v < m.vertex_count(); ++v)
    if ((m.point(v) - p).squaredNorm() < (m.point(best) - p).squaredNorm()) best = v;
  return best;
}

// Square cells of width h, nx by ny, centred at 0, diagonals alternating by row: every inner vertex has 6 neighbours.
// position(x, y) bends the plane.
template <class Position>
Soup row_grid(Index nx, Index ny, Real h, const Position& position) {
  Soup s;
  for (Index j = 0; j <= ny; ++j)
    for (Index i = 0; i <= nx; ++i) add_vertex(s, position((i - nx / 2.0) * h, (j - ny / 2.0) * h));
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i) {
      const Index a = j * (nx + 1) + i, b = a + 1, d = a + nx + 1, c = d + 1;
      if (j % 2 == 0)
        add_face(s, a, b, c), add_face(s, a, c, d);
      else
        add_face(s, a, b, d), add_face(s, b, c, d);
    }
  return s;
}

}  // namespace intarsia::test
