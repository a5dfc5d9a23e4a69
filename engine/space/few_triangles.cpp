#include "engine/space/few_triangles.h"

#include <algorithm>
#include <limits>

#include "engine/space/point_triangle.h"

namespace intarsia {
namespace {

enum Field { ax, ay, az, bx, by, bz, cx, cy, cz, bb, cc, bc, inv_b, inv_c, inv_a, inv_plane, kFields };

// Squared distances by the quadratic forms of the sides u = b - a, v = c - a: with d = p - a, all that is asked of p
// are |d|^2, u.d and v.d.
INTARSIA_WIDE void estimate_all(const Real* field, std::size_t stride, const Real* p, Real* out) {
  const Lanes zero{}, one = zero + 1.0;
  const Real px = p[0], py = p[1], pz = p[2];
  for (std::size_t i = 0; i < stride; i += kLanes) {
    const Real* const f = field + i;
    const Lanes dx = px - lanes_at(f + ax * stride), dy = py - lanes_at(f + ay * stride),
                dz = pz - lanes_at(f + az * stride);
    const Lanes dd = dx * dx + dy * dy + dz * dz;
    const Lanes ud = dx * lanes_at(f + bx * stride) + dy * lanes_at(f + by * stride) + dz * lanes_at(f + bz * stride);
    const Lanes vd = dx * lanes_at(f + cx * stride) + dy * lanes_at(f + cy * stride) + dz * lanes_at(f + cz * stride);
    const Lanes uu = lanes_at(f + bb * stride), vv = lanes_at(f + cc * stride), uv = lanes_at(f + bc * stride);
    const Lanes plane = lanes_at(f + inv_plane * stride);
    const Lanes s = (vv * ud - uv * vd) * plane, t = (uu * vd - uv * ud) * plane;
    const Lanes ww = uu - 2.0 * uv + vv, wd = (vd - ud) - (uv - uu), ee = dd - 2.0 * ud + uu;  // side b to c, e = p - b
    Lanes k = ud * lanes_at(f + inv_b * stride);
    k = k < zero ? zero : k > one ? one : k;
    Lanes least = dd - k * (2.0 * ud - k * uu);
    k = vd * lanes_at(f + inv_c * stride);
    k = k < zero ? zero : k > one ? one : k;
    const Lanes along_c = dd - k * (2.0 * vd - k * vv);
    least = along_c < least ? along_c : least;
    k = wd * lanes_at(f + inv_a * stride);
    k = k < zero ? zero : k > one ? one : k;
    const Lanes along_a = ee - k * (2.0 * wd - k * ww);
    least = along_a < least ? along_a : least;
    const Lanes low = s < t ? s : t, most = s + t;
    const Lanes inside = low < zero ? least : dd - (s * ud + t * vd);
    lanes_at(out + i) = most > one ? least : inside;
  }
}

}  // namespace

void FewTriangles::assign(std::span<const Vec3> point, std::span<const std::array<Index, 3>> triangle) {
  constexpr Real kThin = 1e-6;     // squared double area over the longest side to the 4th
  constexpr Real kSlack = 1e-9;    // of the squared extent: rounding, over what is least thin
  constexpr Real kFarAway = 1e30;  // fills the last lanes
  point_ = point, triangle_ = triangle;
  const std::size_t n = triangle.size(), stride = whole_lanes(n);
  field_.resize(kFields * stride);
  estimate_.resize(stride);
  thin_.clear();
  Real* const f = field_.data();
  std::fill(f, f + kFields * stride, Real{0});
  for (std::size_t t = n; t < stride; ++t) f[ax * stride + t] = kFarAway;
  Vec3 low = point[triangle[0][0]], high = low;
  for (std::size_t t = 0; t < n; ++t) {
    const Vec3 &a = point[triangle[t][0]], &b = point[triangle[t][1]], &c = point[triangle[t][2]];
    low = low.cwiseMin(a).cwiseMin(b).cwiseMin(c), high = high.cwiseMax(a).cwiseMax(b).cwiseMax(c);
    const Vec3 u = b - a, v = c - a;
    const Real uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), ww = (v - u).squaredNorm();
    const Real plane = u.cross(v).squaredNorm(), longest = std::max({uu, vv, ww});
    if (!(plane > kThin * longest * longest)) {
      f[ax * stride + t] = kFarAway;
      thin_.push_back(static_cast<Index>(t));
      continue;
    }
    const Real value[kFields] = {a.x(), a.y(), a.z(), u.x(), u.y(),  u.z(),  v.x(),  v.y(),
                                 v.z(), uu,    vv,    uv,    1 / uu, 1 / vv, 1 / ww, 1 / plane};
    for (std::size_t k = 0; k < kFields; ++k) f[k * stride + t] = value[k];
  }
  slack_ = kSlack * (high - low).squaredNorm();
}

FewTriangles::Nearest FewTriangles::nearest(const Vec3& p) {
  constexpr Real kRelative = 1e-6;
  Real* const estimate = estimate_.data();
  estimate_all(field_.data(), whole_lanes(triangle_.size()), p.data(), estimate);
  Real nearest = std::numeric_limits<Real>::infinity();
  for (std::size_t t = 0; t < triangle_.size(); ++t) nearest = std::min(nearest, estimate[t]);
  const Real enough = nearest * (1 + kRelative) + slack_;
  Nearest least{std::numeric_limits<Real>::infinity(), 0, p};
  const auto ask = [&](std::size_t t) {
    const auto& [a, b, c] = triangle_[t];
    const Vec3 q = closest_on_triangle(p, point_[a], point_[b], point_[c]);
    const Real d2 = (p - q).squaredNorm();
    if (d2 < least.distance2 || (d2 == least.distance2 && t < least.triangle)) least = {d2, t, q};
  };
  for (std::size_t t = 0; t < triangle_.size(); ++t)
    if (estimate[t] <= enough) ask(t);
  for (const Index t : thin_) ask(t);
  return least;
}

}  // namespace intarsia
