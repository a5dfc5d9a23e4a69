// A surface cut into cells, small enough to forget the mesh: what a union of cells is bounded by, how long that border
// is, and how well the union is rebuilt from it, all without touching a face.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/layout_graph.h"
#include "engine/data/patch_labels.h"
#include "engine/parallel/work.h"
#include "engine/space/outline.h"

namespace intarsia::kernels {

struct CellOptions {
  int smoothing = 10;       // steps of averaging of free arcs: the final smoothing of borders is to come
  Index samples = 2000;     // sample points on the whole surface, about
  Index least_samples = 6;  // in each cell
};

struct CellComplex {
  // Half-arc h = 2 * arc or 2 * arc + 1, as in LayoutGraph: its cell lies on the left.
  std::vector<Index> next;        // half-arc -> the one after it around its cell; kNone outside the surface
  std::vector<Index> half_cell;   // half-arc -> cell, kNone outside
  std::vector<Index> start, end;  // per arc: nodes
  Csr cell_halves;                // cell -> its half-arcs
  std::vector<Index> arc_offset;  // arc -> its points, both ends included
  std::vector<Vec3> point;
  std::vector<Vec3> inward[2];  // per point of an arc: where the surface goes on its left and its right, unit or zero
  std::vector<Real> length, salience;  // per arc; salience: integral of theta^2 ds
  std::vector<std::uint8_t> given;     // per arc: 1 if it carries a curve that the user gave; empty: none does
  std::vector<Real> area;              // per cell
  std::vector<int> open_euler;         // per cell: 2 - 2 genus - loops; 1 for a disc
  Csr samples;                         // cell -> sample points
  std::vector<Vec3> sample;
  std::vector<Real> weight;          // per sample: area it stands for
  std::vector<std::uint8_t> corner;  // per node: 1 where a feature turns or two kinds of curve meet
  Index nodes = 0;
  Real hole_length = 0;  // loops of the surface's boundary shorter than this count as filled

  Index cells() const { return static_cast<Index>(area.size()); }
  Index arcs() const { return static_cast<Index>(length.size()); }
  std::span<const Vec3> arc_points(Index a) const {
    return std::span(point).subspan(arc_offset[a], arc_offset[a + 1] - arc_offset[a]);
  }
  bool is_given(Index half) const { return !given.empty() && given[half / 2] != 0; }
  Index half_start(Index h) const { return h % 2 ? end[h / 2] : start[h / 2]; }
};

// refined: the mesh the cells' graph lies on; graph: trace_boundaries of the cells; table: measure_patches of them.
CellComplex make_cell_complex(const Work& work, const RefinedMesh& refined, const PatchLabels& cells,
                              const PatchTable& table, const LayoutGraph& graph, Real hole_length,
                              const CellOptions& options);

}  // namespace intarsia::kernels
