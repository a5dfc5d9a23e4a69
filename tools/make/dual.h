// Numbers that carry their gradient with respect to x, y, z (forward differentiation): a field written once as a
// template gives both its value and its exact gradient.
#pragma once

#include <cmath>

#include "engine/base/types.h"

namespace intarsia::tools {

struct Dual {
  Real v = 0, x = 0, y = 0, z = 0;  // value and its three partial derivatives

  Dual() = default;
  Dual(Real value) : v(value) {}  // NOLINT: a constant is a number with zero gradient
  Dual(Real value, Real dx, Real dy, Real dz) : v(value), x(dx), y(dy), z(dz) {}
};

// f(a) with derivative d at a.
inline Dual chain(const Dual& a, Real f, Real d) { return {f, d * a.x, d * a.y, d * a.z}; }

inline Dual operator-(const Dual& a) { return {-a.v, -a.x, -a.y, -a.z}; }
inline Dual operator+(const Dual& a, const Dual& b) { return {a.v + b.v, a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Dual operator-(const Dual& a, const Dual& b) { return {a.v - b.v, a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Dual operator*(const Dual& a, const Dual& b) {
  return {a.v * b.v, a.v * b.x + b.v * a.x, a.v * b.y + b.v * a.y, a.v * b.z + b.v * a.z};
}
inline Dual operator*(const Dual& a, Real s) { return {a.v * s, a.x * s, a.y * s, a.z * s}; }
inline Dual operator*(Real s, const Dual& a) { return a * s; }
inline Dual operator+(const Dual& a, Real s) { return {a.v + s, a.x, a.y, a.z}; }
inline Dual operator+(Real s, const Dual& a) { return a + s; }
inline Dual operator-(const Dual& a, Real s) { return {a.v - s, a.x, a.y, a.z}; }
inline Dual operator-(Real s, const Dual& a) { return {s - a.v, -a.x, -a.y, -a.z}; }
inline Dual operator/(const Dual& a, Real s) { return a * (1 / s); }
inline Dual operator/(const Dual& a, const Dual& b) {
  const Real q = a.v / b.v, i = 1 / b.v;
  return {q, (a.x - q * b.x) * i, (a.y - q * b.y) * i, (a.z - q * b.z) * i};
}

inline Real value_of(Real a) { return a; }
inline Real value_of(const Dual& a) { return a.v; }

inline Real square(Real a) { return a * a; }
inline Dual square(const Dual& a) { return chain(a, a.v * a.v, 2 * a.v); }
// The gradient of a root at zero is taken as zero: it never matters on a surface.
inline Real root(Real a) { return std::sqrt(a); }
inline Dual root(const Dual& a) {
  const Real r = std::sqrt(a.v);
  return chain(a, r, r > 0 ? 0.5 / r : 0);
}
inline Real magnitude(Real a) { return std::abs(a); }
inline Dual magnitude(const Dual& a) { return a.v < 0 ? -a : a; }
inline Real exponential(Real a) { return std::exp(a); }
inline Dual exponential(const Dual& a) {
  const Real e = std::exp(a.v);
  return chain(a, e, e);
}
inline Real sine(Real a) { return std::sin(a); }
inline Dual sine(const Dual& a) { return chain(a, std::sin(a.v), std::cos(a.v)); }
inline Real cosine(Real a) { return std::cos(a); }
inline Dual cosine(const Dual& a) { return chain(a, std::cos(a.v), -std::sin(a.v)); }

template <class T>
T smaller(const T& a, const T& b) {
  return value_of(b) < value_of(a) ? b : a;
}
template <class T>
T larger(const T& a, const T& b) {
  return value_of(a) < value_of(b) ? b : a;
}
// max(a, 0)
template <class T>
T positive(const T& a) {
  return value_of(a) > 0 ? a : T(0);
}
template <class T>
T length(const T& a, const T& b) {
  return root(square(a) + square(b));
}
template <class T>
T length(const T& a, const T& b, const T& c) {
  return root(square(a) + square(b) + square(c));
}

// length(max(a, 0), max(b, 0)), cheaply: most points lie beside one of the two only.
template <class T>
T corner_length(const T& a, const T& b) {
  if (value_of(a) <= 0) return positive(b);
  if (value_of(b) <= 0) return a;
  return length(a, b);
}

}  // namespace intarsia::tools
