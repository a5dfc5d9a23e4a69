// Sphere, ellipsoid, torus, rounded box.
#include <algorithm>

#include "tools/make/fields.h"

namespace intarsia::tools {

namespace {

struct Sphere {
  Real radius;
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return length(x, y, z) - radius;
  }
};

struct Ellipsoid {
  Real a, b, c;
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return (length(T(x / a), T(y / b), T(z / c)) - 1.0) * std::min({a, b, c});
  }
};

struct Torus {
  Real ring, tube;
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return length(T(length(x, y) - ring), z) - tube;
  }
};

struct RoundedBox {
  Real hx, hy, hz, fillet;  // half sizes of the box that the fillet rounds from outside
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T qx = magnitude(x) - hx, qy = magnitude(y) - hy, qz = magnitude(z) - hz;
    const T inner = larger(qx, larger(qy, qz));
    if (value_of(inner) <= 0) return inner - fillet;
    return length(positive(qx), positive(qy), positive(qz)) - fillet;
  }
};

}  // namespace

std::unique_ptr<Field> sphere_field(Real radius) {
  return make_field(Sphere{radius}, Vec3::Constant(-radius), Vec3::Constant(radius));
}

std::unique_ptr<Field> ellipsoid_field(Real a, Real b, Real c) {
  return make_field(Ellipsoid{a, b, c}, Vec3(-a, -b, -c), Vec3(a, b, c));
}

std::unique_ptr<Field> torus_field(Real ring, Real tube) {
  const Vec3 high(ring + tube, ring + tube, tube);
  return make_field(Torus{ring, tube}, -high, high);
}

std::unique_ptr<Field> rounded_box_field(const Vec3& half, Real fillet) {
  const Vec3 inner = half - Vec3::Constant(fillet);
  return make_field(RoundedBox{inner.x(), inner.y(), inner.z(), fillet}, -half, half);
}

}  // namespace intarsia::tools
