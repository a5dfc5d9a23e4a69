// Least squares of the adjacent-normal cubic, by sums over the fit points: nothing is stored per point.
//
// h(x, y) = (b0 x^2 + 2 b1 xy + b2 y^2)/2 + (c0 x^3 + 3 c1 x^2 y + 3 c2 x y^2 + c3 y^3)/6 + g1 x + g2 y + a
// Every point gives three rows: height h = z and the two slopes of its normal (Goldfeather, Interrante 2004). The
// unknowns are taken in the order b0 b1 b2 c0 c1 c2 c3 g1 g2 a, so that leading parts make the models: 3 quadratic, 7
// the paper's Eq. 1, 9 with a free tangent plane, 10 with a free plane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/base/lanes.h"
#include "engine/base/types.h"

namespace intarsia::kernels {

inline constexpr std::size_t kCubicTerms = 10;

// Sums of w x^i y^j (degree at most 6), w z x^i y^j (3), w p x^i y^j and w q x^i y^j (2); p and q are the slopes dh/dx
// and dh/dy of a point. Monomials are ordered by degree, then by the power of y.
struct CubicSums {
  std::array<Real, 28> moment{};
  std::array<Real, 10> height{};
  std::array<Real, 6> slope_x{}, slope_y{};
  Real distance = 0;  // sum of w times the 3D distance from the centre
  Index count = 0;

  // One point; for tests and small sets. w > 0.
  void add(Real x, Real y, Real z, Real p, Real q, Real w, Real d);
  // The unit of the fit: weighted mean 3D distance of the points.
  Real unit() const { return moment[0] > 0 ? distance / moment[0] : 0; }
};

// Points gathered around a centre, side by side.
struct PointBatch {
  LaneArray x, y, z;     // offset from the centre
  LaneArray nx, ny, nz;  // unit normal
  LaneArray weight;
  std::size_t count = 0;

  void clear() { count = 0; }
  void reserve(std::size_t n) {
    if (x.size() < n + kLanes)
      for (LaneArray* a : {&x, &y, &z, &nx, &ny, &nz, &weight}) a->resize(2 * n + kLanes);
  }
  // Requires: room for it.
  void push(const Vec3& offset, const Vec3& normal, Real w) {
    x.data()[count] = offset.x(), y.data()[count] = offset.y(), z.data()[count] = offset.z();
    nx.data()[count] = normal.x(), ny.data()[count] = normal.y(), nz.data()[count] = normal.z();
    weight.data()[count++] = w;
  }
};

// How a point's normal (a, b, c) and height z in the frame become rows.
enum class Rows : std::uint8_t {
  slopes,  // -a/c, -b/c and z, as in the paper. On a sphere they grow faster than any cubic.
  round,   // -a, -b and z (1 + c)/2: exactly linear and quadratic on spheres and cylinders, and equal to the paper's up
           // to the order that curvature and extremality at the centre are made of
};

// Adds the batch, seen in the frame (u, v, n), to the sums. Points with c < gate are left out. Eight partial sums are
// kept side by side, so the result depends on the order of the points only. Fills the batch up to whole lanes.
// Requires: gate > 0.
void add_points(PointBatch& batch, const Vec3& u, const Vec3& v, const Vec3& n, Real gate, Rows rows, CubicSums& sums);

// Coefficients in the units of the points.
struct CubicFit {
  std::array<Real, 3> b{};
  std::array<Real, 4> c{};
  std::array<Real, 2> gradient{};
  Real offset = 0;
};

// Solves the normal equations of the first `terms` unknowns, with lengths in units of sums.unit() (that makes the
// result independent of the scale of the model and keeps the condition number near 12), by LDL^T. Requires: terms is 3,
// 7, 9 or 10. Returns false, leaving fit as it was, if the smallest pivot is below `least_pivot` times the largest.
bool solve_cubic(const CubicSums& sums, std::size_t terms, Real least_pivot, CubicFit& fit);

}  // namespace intarsia::kernels
