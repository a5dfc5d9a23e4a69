// A closed surface as the zero set of a function, negative inside.
#pragma once

#include <memory>
#include <utility>

#include "engine/base/types.h"
#include "tools/make/dual.h"

namespace intarsia::tools {

// Ensures: |value(p) - value(q)| <= |p - q| everywhere, so that |value(p)| is a lower bound of the distance to the
// surface; differentiable near the surface, with a gradient that does not vanish there.
class Field {
 public:
  virtual ~Field() = default;
  virtual Real value(const Vec3& p) const = 0;
  virtual Real value(const Vec3& p, Vec3& gradient) const = 0;

  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // a box that holds the surface
};

// F: template <class T> T operator()(const T& x, const T& y, const T& z) const.
template <class F>
class FieldOf final : public Field {
 public:
  FieldOf(F f, const Vec3& lo, const Vec3& hi) : f_(std::move(f)) { low = lo, high = hi; }
  Real value(const Vec3& p) const override { return f_(p.x(), p.y(), p.z()); }
  Real value(const Vec3& p, Vec3& gradient) const override {
    const Dual d = f_(Dual(p.x(), 1, 0, 0), Dual(p.y(), 0, 1, 0), Dual(p.z(), 0, 0, 1));
    gradient = Vec3(d.x, d.y, d.z);
    return d.v;
  }

 private:
  F f_;
};

template <class F>
std::unique_ptr<Field> make_field(F f, const Vec3& low, const Vec3& high) {
  return std::make_unique<FieldOf<F>>(std::move(f), low, high);
}

// One Newton step towards the surface along the gradient, at most `reach` long. Returns the value before the step.
inline Real step_to_surface(const Field& field, Vec3& p, Real reach) {
  Vec3 g;
  const Real f = field.value(p, g), g2 = g.squaredNorm();
  if (!(g2 > 1e-20)) return f;
  Vec3 step = -(f / g2) * g;
  const Real l = step.norm();
  if (l > reach) step *= reach / l;
  p += step;
  return f;
}

}  // namespace intarsia::tools
