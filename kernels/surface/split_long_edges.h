// Makes the long thin triangles of CAD tessellations into short ones, without moving the surface: longest edges are
// halved until none is longer than wanted, neighbours first where theirs are longer.
// Source: Rivara 1997, "New longest-edge algorithms for the refinement and/or improvement of unstructured
// triangulations" (longest-edge propagation paths).
#pragma once

#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct SplitEdgesOptions {
  Real uneven = 1;            // coefficient of variation of the edge lengths from which triangles count as uneven
  Real length = 0.008;        // longest edge wanted, diagonals
  Real most_triangles = 3e5;  // longer edges are allowed where there would be more
  Index few = 1000;           // triangles that a polyhedral mesh has at most
};

// Standard deviation / mean of the edge lengths (each edge as often as it has triangles).
Real edge_variation(const Work& work, const Soup& soup);

// A few flat faces meeting in creases, as boxes come from CAD programs: at most options.few triangles, and hardly an
// edge turns by an angle between flat and sharp. Such a mesh has nothing around its creases to tell them from noise by.
bool is_polyhedral(const Work& work, const Soup& soup, const SplitEdgesOptions& options);

// The longest edge to divide to, diagonals: as wanted, or longer as far as the triangles would be too many.
Real split_length(const Work& work, const Soup& soup, Real diagonal, const SplitEdgesOptions& options);

struct SplitSoup {
  Soup soup;                  // the vertices with their numbers, then the middles of edges
  std::vector<Index> parent;  // triangle -> triangle it is a part of
};

// Two triangles with the same three corners, back to back: their halves would have four triangles on one edge.
bool has_pillows(const Work& work, const Soup& soup);

// Every triangle with a longer edge is divided into triangles with the same plane and, together, the same area. No
// vertex in the middle of a neighbour's edge is left. `length` in model units, > 0. Serial, linear in what it makes.
// Requires: check_soup accepts the soup; it has no pillows.
SplitSoup split_long_edges(const Work& work, const Soup& soup, Real length);

}  // namespace intarsia::kernels
