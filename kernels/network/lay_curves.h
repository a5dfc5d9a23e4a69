// Polylines in space laid onto the surface: what a user drew becomes curves of the network.
#pragma once

#include <span>
#include <vector>

#include "engine/data/curve_network.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct LayOptions {
  Real corner = 1e-3;    // points nearer to a vertex or an edge than this share of the triangle are put onto it
  Real step = 2;         // mean edges: longer segments are laid in pieces
  Real farthest = 0.05;  // diagonals: points farther from the surface than this belong to another shape
};

struct LaidCurves {
  CurveNetwork net;   // kind given
  Real farthest = 0;  // of the points from the surface
  Index gaps = 0;     // places where a curve could not go on, at holes of the surface; it begins anew behind them
};

// Every point goes to the nearest place on the surface, points in between are added where segments cross mesh edges. A
// polyline that ends where it began is closed. Polylines of a single place become no curve.
// Requires: mean_edge > 0; finite points, in the mesh's coordinates.
// Ensures: neighbours in a curve share a face. The same bits for any number of threads.
// Errors: rejected (element = polyline) if a point is farther away than options.farthest.
LaidCurves lay_curves(const Work& work, const MeshView& mesh, Real mean_edge,
                      std::span<const std::vector<Vec3>> polylines, const LayOptions& options = {});

}  // namespace intarsia::kernels
