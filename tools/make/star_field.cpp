// A star of curved, crisp ridges that fade out towards its poles.
#include <cmath>

#include "tools/make/fields.h"

namespace intarsia::tools {

namespace {

// |p| against a radius that depends on the direction, z squeezed. Ridges run where the turned angle is a multiple of
// 2 pi / petals; their crest is a hyperbola of width `crease`, between them lie smooth valleys.
constexpr Real kFlat = 1 / 0.9;  // squeeze along z
constexpr Real kCore = 0.6;      // inside this radius the direction shrinks: no singularity at the origin

struct Star {
  int petals;
  Real depth, crease, twist, slope;

  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T sz = z * kFlat;
    const T r = length(x, y, sz), unit = larger(r, T(kCore));
    const T ux = x / unit, uy = y / unit, uz = sz / unit;
    const T rho2 = square(ux) + square(uy), rho = root(T(rho2 + 1e-20));
    // cos(petals * (angle - twist * z)) from powers of (ux + i uy) / rho.
    const T turn = uz * twist;
    T cr = T(1), ci = T(0);
    const T cx = ux / rho, cy = uy / rho, tc = cosine(turn), ts = sine(turn);
    const T ex = cx * tc + cy * ts, ey = cy * tc - cx * ts;
    for (int k = 0; k < petals; ++k) {
      const T re = cr * ex - ci * ey;
      ci = cr * ey + ci * ex;
      cr = re;
    }
    const T valley = root(T((1.0 - cr) * 0.5 + crease * crease));  // `crease` on a crest, about 1 between two
    return (r - radius(rho2, uz, valley)) / (kFlat * slope);
  }
  template <class T>
  T radius(const T& rho2, const T& uz, const T& valley) const {
    const T fade = square(rho2) / (square(rho2) + 0.3);
    return 1.0 - 0.1 * square(uz) + fade * (0.6 - depth * valley);
  }
};

}  // namespace

Vec3 star_crest(Real petals, Real depth, Real crease, Real twist, int ridge, Real height) {
  const Real n = std::round(petals), rho = std::sqrt(1 - height * height);
  const Star star{static_cast<int>(n), depth, crease, twist, 1};
  const Real r = star.radius(rho * rho, height, crease), angle = twist * height + 6.283185307179586 * ridge / n;
  return {r * rho * std::cos(angle), r * rho * std::sin(angle), r * height / kFlat};
}

std::unique_ptr<Field> star_field(Real petals, Real depth, Real crease, Real twist) {
  const Real n = std::round(petals);
  // Steepest change of the radius over the sphere, outside the core: flanks of the ridges, plus the turn.
  const Real angular = (depth * (0.5 * n) * std::hypot(1.0, twist) + 1.2) / kCore;
  const Star star{static_cast<int>(n), depth, crease, twist, std::hypot(1.0, angular)};
  return make_field(star, Vec3(-1.5, -1.5, -1.1), Vec3(1.5, 1.5, 1.1));
}

}  // namespace intarsia::tools
