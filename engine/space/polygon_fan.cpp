#include "engine/space/polygon_fan.h"

#include <cmath>
#include <limits>

namespace intarsia::polygon {

INTARSIA_WIDE void open_fan(const Real* px, const Real* py, const Real* pz, const Real* ends, Real least_area,
                            const Row& l, const Row& r, Index from, Index to, const Fan& out) {
  const Lanes zero{}, one = zero + 1.0, half = zero + 0.5;
  const Real ax = ends[0], ay = ends[1], az = ends[2], vx = ends[3] - ax, vy = ends[4] - ay, vz = ends[5] - az;
  for (std::size_t m = from / kLanes * kLanes; m < to; m += kLanes) {
    const Lanes ux = lanes_at(px + m) - ax, uy = lanes_at(py + m) - ay, uz = lanes_at(pz + m) - az;
    const Lanes cx = uy * vz - uz * vy, cy = uz * vx - ux * vz, cz = ux * vy - uy * vx;
    const Lanes squared = cx * cx + cy * cy + cz * cz;
    Lanes length;
    for (std::size_t lane = 0; lane < kLanes; ++lane) length[lane] = std::sqrt(squared[lane]);
    const Lanes area = half * length;
    const Lanes f = area > least_area ? one : zero, scale = area > least_area ? one / length : zero;
    const Lanes nx = cx * scale, ny = cy * scale, nz = cz * scale;
    const Lanes bl =
        lanes_at(l.weight + m) *
        (f * lanes_at(l.flag + m) - (nx * lanes_at(l.x + m) + ny * lanes_at(l.y + m) + nz * lanes_at(l.z + m)));
    const Lanes br =
        lanes_at(r.weight + m) *
        (f * lanes_at(r.flag + m) - (nx * lanes_at(r.x + m) + ny * lanes_at(r.y + m) + nz * lanes_at(r.z + m)));
    const Lanes left = lanes_at(l.cost + m) + (bl > 0.0 ? bl : zero);
    const Lanes right = lanes_at(r.cost + m) + (br > 0.0 ? br : zero);
    lanes_at(out.area + m) = area, lanes_at(out.flag + m) = f;
    lanes_at(out.x + m) = nx, lanes_at(out.y + m) = ny, lanes_at(out.z + m) = nz;
    lanes_at(out.left + m) = left, lanes_at(out.right + m) = right, lanes_at(out.sum + m) = area + (left + right);
  }
}

INTARSIA_WIDE Index first_least(const Real* x, Index from, Index to) {
  constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
  constexpr Index kWidth = static_cast<Index>(kLanes);
  const Index inner = (from + kWidth - 1) / kWidth * kWidth, outer = to / kWidth * kWidth;  // whole lanes between
  Real least = kInfinity;
  if (inner < outer) {
    Lanes low = lanes_at(x + inner);
    for (Index m = inner + kWidth; m < outer; m += kWidth) {
      const Lanes here = lanes_at(x + m);
      low = here < low ? here : low;
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) least = low[lane] < least ? low[lane] : least;
    for (Index m = from; m < inner; ++m) least = x[m] < least ? x[m] : least;
    for (Index m = outer; m < to; ++m) least = x[m] < least ? x[m] : least;
  } else {
    for (Index m = from; m < to; ++m) least = x[m] < least ? x[m] : least;
  }
  if (!(least < kInfinity)) return to;
  Index at = from;
  while (x[at] != least) ++at;
  return at;
}

INTARSIA_WIDE Real least_with_bend(const PolygonScratch::Pack* pack, Index packs, Real weight, const Real* front,
                                   Real least) {
  const Lanes zero{};
  for (Index p = 0; p < packs && pack[p].cost[0] < least; ++p) {
    const auto& c = pack[p];
    const Lanes bend = weight * (front[0] * lanes_at(c.flag) -
                                 (front[1] * lanes_at(c.x) + front[2] * lanes_at(c.y) + front[3] * lanes_at(c.z)));
    const Lanes cost = lanes_at(c.cost) + (bend > 0.0 ? bend : zero);
    Real low[4];
    for (std::size_t lane = 0; lane < 4; ++lane) low[lane] = cost[lane] < cost[lane + 4] ? cost[lane] : cost[lane + 4];
    const Real even = low[0] < low[2] ? low[0] : low[2], odd = low[1] < low[3] ? low[1] : low[3];
    const Real lowest = even < odd ? even : odd;
    least = lowest < least ? lowest : least;
  }
  return least;
}

INTARSIA_WIDE void least_angles2(const PolygonScratch::Pack& c, const Real* front, Real* out) {
  const Lanes zero{};
  const Lanes u =
      front[0] * lanes_at(c.flag) - (front[1] * lanes_at(c.x) + front[2] * lanes_at(c.y) + front[3] * lanes_at(c.z));
  const Lanes least = u * (2.0 + u * (1.0 / 3 + u * (4.0 / 45))) * (1 - 1e-12) - 1e-15;
  lanes_at(out) = least > 0.0 ? least : zero;
}

}  // namespace intarsia::polygon
