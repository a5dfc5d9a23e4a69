// Feature curves with what is known at their points and of each curve as a whole. Lengths are in units of the
// bounding-box diagonal, curvatures in its inverse, angles in radians.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/curve_network.h"
#include "engine/data/mesh.h"

namespace intarsia {

// Kinds ridge, valley and sharp. Consecutive points of a curve lie in one common face (closed). Points that no curve
// uses may remain in the arrays until select_curves() drops them.
struct FeatureCurves {
  CurveNetwork net;  // net.strength is the turn angle theta across the curve

  // Per point.
  Vec3Array normal;               // unit
  Vec3Array across;               // unit tangent across the curve: t_max on a ridge, t_min in a valley
  std::vector<Real> kd;           // curvature across, positive for both channels: k_max, or -k_min in a valley
  std::vector<Real> kmax, kmin;   // signed, as in CurvatureFields
  std::vector<Real> extremality;  // sqrt(e_max^2 + e_min^2), interpolated from the ends of the mesh edge (Eq. 7)
  std::vector<Real> sharpness;    // -k'' / kd^3 across the curve (wide discs: twice the relative drop of k beside
                                   // it): about 0 on cylinders, tori and spheres
  std::vector<Real> radius;       // rho of the fit: mean distance of its points

  // Per curve.
  std::vector<std::uint8_t> concave;  // channel: 0 convex (ridges), 1 concave (valleys); sharp curves have either
  std::vector<Real> length;           // L
  std::vector<Real> rms_curvature;    // R
  std::vector<Real> strength;         // T (Eq. 7)
  std::vector<Real> saliency;         // integral of theta along the curve
  std::vector<Index> component;       // curves that share points, directly or in turn, have the same component

  // Per component: sums over its curves, and whether it passed every test but that of its saliency.
  std::vector<Real> component_saliency;
  std::vector<std::uint8_t> component_passed;

  Index point_count() const { return static_cast<Index>(net.point.size()); }
  Index curve_count() const { return net.curve_count(); }
  std::span<const Index> points_of(Index c) const { return net.curve.row(c); }
  std::vector<Real>& turn() { return net.strength; }
  const std::vector<Real>& turn() const { return net.strength; }

  void resize_points(std::size_t n) {
    net.point.resize(n), net.strength.resize(n), normal.resize(n), across.resize(n);
    for (auto* a : {&kd, &kmax, &kmin, &extremality, &sharpness, &radius}) a->resize(n);
  }
  void copy_point(Index to, const FeatureCurves& from, Index i) {
    net.point[to] = from.net.point[i], net.strength[to] = from.net.strength[i];
    normal.set(to, from.normal[i]), across.set(to, from.across[i]);
    kd[to] = from.kd[i], kmax[to] = from.kmax[i], kmin[to] = from.kmin[i];
    extremality[to] = from.extremality[i], sharpness[to] = from.sharpness[i], radius[to] = from.radius[i];
  }
  // Measures are not kept up to date by this: see kernels/curves/measure_curves.h.
  void add_curve(const std::vector<Index>& points, CurveKind kind, bool is_concave) {
    net.add_curve(points, kind);
    concave.push_back(is_concave ? 1 : 0);
  }
};

}  // namespace intarsia
