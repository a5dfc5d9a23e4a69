#include "engine/base/orientation.h"

#include <cmath>
#include <vector>

namespace intarsia {
namespace {

constexpr Real kHalfUnit = 0x1p-53;  // of the last place

// A sum of numbers that do not overlap, smallest first: exact.
class Expansion {
 public:
  Expansion() = default;
  // a - b
  Expansion(Real a, Real b) { add(a), add(-b); }

  void add(Real value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < part_.size(); ++i) {
      const Real sum = value + part_[i], virtual_part = sum - value;
      const Real rest = (value - (sum - virtual_part)) + (part_[i] - virtual_part);
      if (rest != 0) part_[kept++] = rest;
      value = sum;
    }
    part_.resize(kept);
    if (value != 0) part_.push_back(value);
  }
  void add_product(const Expansion& a, const Expansion& b) {
    for (const Real x : a.part_)
      for (const Real y : b.part_) {
        const Real product = x * y;
        add(std::fma(x, y, -product));
        add(product);
      }
  }
  Expansion negated() const {
    Expansion e = *this;
    for (Real& p : e.part_) p = -p;
    return e;
  }
  int sign() const { return part_.empty() ? 0 : part_.back() > 0 ? 1 : -1; }

 private:
  std::vector<Real> part_;
};

// a d - b c
Expansion determinant(const Expansion& a, const Expansion& b, const Expansion& c, const Expansion& d) {
  Expansion e;
  e.add_product(a, d);
  e.add_product(b.negated(), c);
  return e;
}

int sign(Real value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  constexpr Real kBound = (7 + 56 * kHalfUnit) * kHalfUnit;
  const Vec3 p = a - d, q = b - d, r = c - d;
  const Real qr = q.x() * r.y(), rq = r.x() * q.y(), rp = r.x() * p.y(), pr = p.x() * r.y(), pq = p.x() * q.y(),
             qp = q.x() * p.y();
  const Real value = p.z() * (qr - rq) + q.z() * (rp - pr) + r.z() * (pq - qp);
  const Real size = (std::abs(qr) + std::abs(rq)) * std::abs(p.z()) + (std::abs(rp) + std::abs(pr)) * std::abs(q.z()) +
                    (std::abs(pq) + std::abs(qp)) * std::abs(r.z());
  if (std::abs(value) > kBound * size) return sign(value);
  Expansion e[3][3];
  for (int i = 0; i < 3; ++i) e[0][i] = {a[i], d[i]}, e[1][i] = {b[i], d[i]}, e[2][i] = {c[i], d[i]};
  Expansion sum;
  for (int i = 0; i < 3; ++i) {
    const auto& m = e[(i + 1) % 3];
    const auto& n = e[(i + 2) % 3];
    sum.add_product(e[i][2], determinant(m[0], m[1], n[0], n[1]));
  }
  return sum.sign();
}

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, int u, int v) {
  constexpr Real kBound = (3 + 16 * kHalfUnit) * kHalfUnit;
  const Real left = (a[u] - c[u]) * (b[v] - c[v]), right = (a[v] - c[v]) * (b[u] - c[u]), value = left - right;
  if (std::abs(value) > kBound * (std::abs(left) + std::abs(right))) return sign(value);
  return determinant({a[u], c[u]}, {a[v], c[v]}, {b[u], c[u]}, {b[v], c[v]}).sign();
}

}  // namespace intarsia
