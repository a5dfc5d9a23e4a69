// How much the surface turns across a curve: the angle between the mean normals of its two sides within a fixed radius.
// A crease of dihedral turn a gives a at any resolution; a cylinder of radius r gives about 0.85 rho / r.
#pragma once

#include "engine/data/feature_curves.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Lengths in units of the bounding-box diagonal.
struct TurnOptions {
  Real radius = 0.02;  // rho; at least radius_in_edges mean edges
  Real radius_in_edges = 2;
  bool follow_fit = true;      // where the curvature fit reached further than rho, its radius (wide fillets)
  Real largest_radius = 0.08;  // of any point
  Real min_side = 0.35;        // in rho: samples closer than this to the curve's tangent belong to no side
  Real max_along = 0.6;        // in rho: nor do samples further than this along the curve
  Real sample_step = 0.25;     // in rho: spacing of the points where the angle is measured; linear between them
  Real finest = 0.2;           // in rho: vertices closer together than this are gathered first
};

// Fills the turn angles of all points on ridges and valleys; sharp curves keep their dihedral turn. The walk around a
// point does not cross sharp curves: what turns there is theirs.
// Requires: edge_length = mean edge length.
// Ensures: values in [0, pi]; a side without samples is replaced by the normal at the point.
void turn_angles(const Work& work, const MeshView& mesh, Real edge_length, const TurnOptions& options,
                 FeatureCurves& curves);

}  // namespace intarsia::kernels
