// A cube with rounded edges, sampled so that the fillets' radius is a given number of mesh edges.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/support/shapes.h"

namespace intarsia::test {

// Edges of the mesh are about 1 long. The cube is 2 * (half + radius) wide, centred at 0: flat parts of width 2 * half.
struct RoundedCube {
  Real half, radius;

  Vec3 inner(const Vec3& p) const { return p.cwiseMax(Vec3::Constant(-half)).cwiseMin(Vec3::Constant(half)); }
  Vec3 project(const Vec3& p) const {
    const Vec3 q = inner(p);
    return q + radius * (p - q).normalized();
  }
  // `jitter`: share of an edge by which vertices slide along the surface.
  Soup mesh(Real jitter, std::uint64_t seed) const {
    const Index bent = std::max<Index>(1, static_cast<Index>(std::lround(radius * std::numbers::pi / 4)));
    const Index flat = static_cast<Index>(std::lround(2 * half));
    const Index n = 2 * bent + flat;
    const auto place = [&](Real u) {  // 0 .. 1 along a side; equal angles in the fillet as seen from its axis
      const Real i = u * n, last = n - Real(bent);
      const Real past = i < bent ? i - bent : i > last ? i - last : 0;
      const Real flat_part = std::clamp(i - bent, Real(0), Real(flat)) - Real(flat) / 2;
      return flat_part * (2 * half / flat) + radius * std::tan(past / bent * std::numbers::pi / 4);
    };
    Soup s = transformed(cube(n), [&](const Vec3& p) { return project({place(p.x()), place(p.y()), place(p.z())}); });
    return jitter > 0 ? jittered(s, jitter, seed, [&](const Vec3&, const Vec3& q) { return project(q); }) : s;
  }
  // The fillet that p lies on: number of coordinates beyond the flat parts (0 face, 1 .. 2 fillet, 3 corner).
  int rounded_axes(const Vec3& p) const {
    return static_cast<int>((p - inner(p)).cwiseAbs().unaryExpr([](Real d) { return d > 1e-9 ? 1.0 : 0.0; }).sum());
  }
  // Distance along the surface from the middle line of the fillet, for rounded_axes(p) == 2.
  Real from_middle(const Vec3& p) const {
    const Vec3 d = (p - inner(p)).cwiseAbs();
    const Real least = d.minCoeff(), most = d.maxCoeff(), middle = d.sum() - least - most;
    return radius * (std::atan2(most, middle) - std::numbers::pi / 4);
  }
};

}  // namespace intarsia::test
