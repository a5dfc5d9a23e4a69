#include "tools/step/spline.h"

#include <algorithm>

namespace intarsia::tools {

Vec2 FaceSurface::nearest(const Vec3& p, const Vec2& start, int steps) const {
  if (is_plane) return {(p - origin).dot(x), (p - origin).dot(y)};
  const SplineDomain& d = spline.domain;
  const Real reach = std::max(d.u_step(), d.v_step());
  Vec2 best = start, at = start;
  Real least = std::numeric_limits<Real>::infinity();
  for (int i = 0; i <= steps; ++i) {
    const SurfacePointAndSlopes s = spline.at(at);
    const Vec3 rest = p - s.point;
    const Real distance = rest.squaredNorm();
    if (distance < least) least = distance, best = at;
    if (i == steps) break;
    const Real a = s.u.dot(s.u), b = s.u.dot(s.v), c = s.v.dot(s.v), det = a * c - b * b;
    if (!(det > 1e-12 * a * c)) break;
    const Real f = s.u.dot(rest), g = s.v.dot(rest);
    Vec2 step((c * f - b * g) / det, (a * g - b * f) / det);
    const Real length = step.norm();
    if (length > reach) step *= reach / length;
    at += step;
    at = at.cwiseMax(d.low).cwiseMin(d.high);
    if (length < 1e-13) break;
  }
  return best;
}

}  // namespace intarsia::tools
