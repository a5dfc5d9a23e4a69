// Meshes cut into known cells.
#pragma once

#include <functional>

#include "kernels/cells/grouping.h"
#include "kernels/layout/trace_boundaries.h"
#include "kernels/patches/flood_patches.h"
#include "kernels/patches/measure_patches.h"
#include "tests/kernels/patches/patch_checks.h"

namespace intarsia::test {

struct CellMesh {
  TestRefinement refinement;
  kernels::PatchSurface surface;
  PatchLabels cells;
  kernels::CellComplex complex;
};

// Cells are the connected sets of faces with equal id(centroid, normal).
inline CellMesh cell_mesh(const Soup& soup, const std::function<Index(const Vec3&, const Vec3&)>& id,
                          Real hole_length = 0, int smoothing = 0) {
  CellMesh m;
  m.refinement = sharp_refinement(soup, 1.0);
  m.surface = surface_of(m.refinement, hole_length);
  std::vector<Index> of_face;
  for (Index f = 0; f < m.surface.mesh.face_count(); ++f)
    of_face.push_back(id(m.surface.centroid(f), m.refinement.normal[f]));
  m.cells = kernels::flood_equal(Work(), m.surface.mesh, of_face);
  const PatchTable table = kernels::measure_patches(Work(), m.surface, m.cells);
  const LayoutGraph graph =
      kernels::trace_boundaries(Work(), m.refinement.refined, m.cells.patch_of_face, m.cells.count);
  kernels::CellOptions options;
  options.smoothing = smoothing;
  m.complex = kernels::make_cell_complex(Work(), m.refinement.refined, m.cells, table, graph, hole_length, options);
  return m;
}

// n x n square cells of the unit square.
inline CellMesh checkered_plane(Index n, Index fine) {
  return cell_mesh(plane(n * fine, n * fine), [n](const Vec3& p, const Vec3&) {
    return static_cast<Index>(p.x() * n) + n * static_cast<Index>(p.y() * n);
  });
}

// The cube's sides, each cut into four squares: 24 cells.
inline Index cube_side(const Vec3& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return static_cast<Index>(2 * axis + (normal[axis] > 0 ? 1 : 0));
}
inline CellMesh quartered_cube(Index fine) {
  return cell_mesh(cube(2 * fine), [](const Vec3& p, const Vec3& n) {
    Index quarter = 0;
    for (int k = 0; k < 3; ++k) quarter = 2 * quarter + (p[k] > 0.5 ? 1 : 0);
    return 8 * cube_side(n) + quarter;
  });
}

}  // namespace intarsia::test
