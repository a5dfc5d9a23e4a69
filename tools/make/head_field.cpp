// A head-like organic shape: smooth blends of ellipsoids and round cones, with curls of hair.
#include "tools/make/fields.h"
#include "tools/make/solids.h"

namespace intarsia::tools {

namespace {

constexpr Real kHairline = 0.05;  // width of the blend between face and hair
constexpr Real kWaves = 10;       // of the hair, per unit of length / 2 pi

// The face looks along -y, z is up.
struct Head {
  Real curls;  // height of the waves of hair

  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T ax = magnitude(x);
    // Skull, face, cheeks, chin, neck.
    T f = ellipsoid_at(x, y, z, {0, 0.12, 0.45}, {0.80, 0.98, 0.88});
    f = unite_smooth(f, ellipsoid_at(x, y, z, {0, -0.30, -0.10}, {0.62, 0.60, 0.80}), 0.35);
    f = unite_smooth(f, ellipsoid_at(ax, y, z, {0.40, -0.62, -0.14}, {0.20, 0.19, 0.15}), 0.22);
    f = unite_smooth(f, ellipsoid_at(x, y, z, {0, -0.66, -0.74}, {0.24, 0.21, 0.15}), 0.22);
    f = unite_smooth(f, round_cone(x, y, z, {0, 0.22, -0.3}, 0.44, {0, 0.30, -1.45}, 0.54), 0.35);
    // Brows, sockets, eyes.
    f = unite_smooth(f, round_cone(ax, y, z, {0.10, -0.84, 0.25}, 0.09, {0.46, -0.66, 0.24}, 0.06), 0.14);
    f = intersect_smooth(f, T(-ellipsoid_at(ax, y, z, {0.27, -0.96, 0.06}, {0.21, 0.22, 0.13})), 0.12);
    f = unite_smooth(f, T(length(T(ax - 0.27), T(y + 0.69), T(z - 0.05)) - 0.14), 0.03);
    // Nose with its wings, lips.
    f = unite_smooth(f, ellipsoid_at(x, y, z, {0, -0.78, -0.02}, {0.12, 0.22, 0.30}), 0.08);
    f = unite_smooth(f, round_cone(x, y, z, {0, -0.84, 0.20}, 0.05, {0, -1.0, -0.18}, 0.10), 0.10);
    f = unite_smooth(f, T(length(T(ax - 0.10), T(y + 0.91), T(z + 0.21)) - 0.075), 0.06);
    f = unite_smooth(f, round_cone(ax, y, z, {0.02, -0.87, -0.455}, 0.055, {0.20, -0.76, -0.49}, 0.025), 0.05);
    f = unite_smooth(f, round_cone(ax, y, z, {0, -0.85, -0.575}, 0.065, {0.17, -0.75, -0.53}, 0.03), 0.04);
    // Ears with their hollows.
    f = unite_smooth(f, ellipsoid_at(ax, y, z, {0.76, 0.10, 0.02}, {0.13, 0.19, 0.27}), 0.06);
    f = intersect_smooth(f, T(-ellipsoid_at(ax, y, z, {0.93, 0.02, 0.04}, {0.10, 0.12, 0.17})), 0.06);
    // Hair behind a slanted line, in waves.
    const Real k = kWaves;
    T hair = ellipsoid_at(x, y, z, {0, 0.20, 0.46}, {0.86, 1.0, 0.94});
    hair = intersect_smooth(hair, T(0.18 - 0.75 * z - 0.66 * y + 0.10 * square(x)), 0.16);
    if (curls > 0 && value_of(hair) - 3 * curls < value_of(f) + kHairline)  // elsewhere it changes nothing
      hair = hair + curls * (sine(T(k * x)) * cosine(T(k * y)) + sine(T(k * y)) * cosine(T(k * z)) +
                             sine(T(k * z)) * cosine(T(k * x)));
    f = unite_smooth(f, hair, kHairline);
    f = intersect_smooth(f, T(-1.38 - z), 0.12);  // the base
    return f / (1.1 + 2.45 * k * curls);          // the waves' slope is at most sqrt(6) k times their height
  }
};

}  // namespace

std::unique_ptr<Field> head_field(Real bumps) {
  return make_field(Head{bumps}, Vec3(-1.1, -1.3, -1.6), Vec3(1.1, 1.3, 1.5));
}

}  // namespace intarsia::tools
