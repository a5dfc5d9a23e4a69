// Fitting planes, spheres, cylinders, cones and general quadrics to pieces of a surface (Taubin 1991, "Estimation of
// planar curves, surfaces, and nonplanar space curves defined by implicit equations").
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/base/types.h"

namespace intarsia::kernels {

enum class QuadricType : std::uint8_t { plane, sphere, cylinder, cone, general };

// f(q) = q^T A q + b.q + c of q = (p - origin) / scale; its gradient points outward on the piece it was fitted to.
struct Quadric {
  Vec3 origin = Vec3::Zero();
  Real scale = 1;
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Vec3 b = Vec3::Zero();
  Real c = 0;
  Real least_gradient = 0;  // an apex has none: |grad f| counts as at least so much
  QuadricType type = QuadricType::plane;

  Vec3 gradient(const Vec3& p) const { return 2 * (a * ((p - origin) / scale)) + b; }
  // Distance to first order: f / |grad f|.
  Real distance(const Vec3& p) const {
    const Vec3 q = (p - origin) / scale, aq = a * q;
    const Real slope = std::max((2 * aq + b).norm(), least_gradient);
    return slope > 0 ? scale * (q.dot(aq) + b.dot(q) + c) / slope : 0;
  }
};

// A triangle of the piece, or a single point three times.
struct QuadricSample {
  std::array<Vec3, 3> corner;
  Vec3 normal;  // unit, or zero
  Real weight;
  Vec3 middle() const { return (corner[0] + corner[1] + corner[2]) / 3; }
};

struct QuadricOptions {
  Real normal_weight = 0;  // of |n - grad f / |grad f||^2 beside the squared distance, a squared length
  Real within = 1.05;      // the simplest type whose error is at most so many times the best
  Real slack = 1e-4;       // and so much more; a length
  std::size_t least = 10;  // fewer samples: a plane
};

// Squared distance, mean over the corners, plus the normal term.
Real quadric_error(const Quadric& quadric, const QuadricSample& sample, Real normal_weight);
// Weighted mean of the same; 0 without weight.
Real quadric_error(const Quadric& quadric, std::span<const QuadricSample> samples, Real normal_weight);

// The simplest type that fits nearly as well as the best (our own rule). Requires: at least one sample.
Quadric fit_quadric(std::span<const QuadricSample> samples, const QuadricOptions& options);
// The best fit of one type; where its system has no solution, the plane. Exact on exact samples.
Quadric fit_quadric(std::span<const QuadricSample> samples, QuadricType type, Real normal_weight);

}  // namespace intarsia::kernels
