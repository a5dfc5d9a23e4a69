// Local slippage analysis (Gelfand, Guibas 2004, "Shape segmentation using local slippage analysis"): which rigid
// motions a piece of a surface slips along itself. Section 15.4.
#pragma once

#include <Eigen/Core>

#include "engine/base/types.h"

namespace intarsia::kernels {

using Vector6 = Eigen::Matrix<Real, 6, 1>;
using Matrix6 = Eigen::Matrix<Real, 6, 6>;

// Sums over weighted points with normals; those of two pieces may be added.
struct SlippageSums {
  Real weight = 0, square = 0;     // sum of w, of w |p|^2
  Vec3 place = Vec3::Zero();       // sum of w p
  Matrix6 form = Matrix6::Zero();  // sum of w c c^T, c = (p x n, n)

  void add(Real w, const Vec3& p, const Vec3& n);
  SlippageSums& operator+=(const SlippageSums& o);
};

// Motions (rotation, translation) of a piece about its centroid, lengths in its root mean square radius.
struct Slippage {
  Vector6 value = Vector6::Zero();       // mean square speed along the normals, ascending
  Matrix6 motion = Matrix6::Identity();  // columns
  Vec3 centre = Vec3::Zero();
  Real radius = 1;

  // How many independent motions slip: value / greatest value below the limit. Plane and sphere 3, cylinder 2, others
  // of extrusion, revolution or helical form 1, freeform 0.
  int dimension(Real limit = 0.05) const;
  // Sum of the `motions` least values.
  Real error(int motions) const { return value.head(motions).sum(); }
  // The same for one point: mean square speed of the first motions along its normal.
  Real error_at(const Vec3& p, const Vec3& n, int motions) const;
};

Slippage slippage_of(const SlippageSums& sums);

}  // namespace intarsia::kernels
