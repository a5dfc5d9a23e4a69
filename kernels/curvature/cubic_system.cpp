#include "kernels/curvature/cubic_system.h"

#include <algorithm>
#include <cmath>

#include "kernels/curvature/cubic_rows.h"

namespace intarsia::kernels {

namespace {

// powers[d] = unit^-d.
template <std::size_t Size>
std::array<Real, Size> scaled(const std::array<Real, Size>& sums, const std::array<Real, 7>& powers, Real factor) {
  std::array<Real, Size> out;
  for (std::size_t i = 0, degree = 0, left = 1; i < Size; ++i) {
    out[i] = sums[i] * (powers[degree] * factor);
    if (--left == 0) ++degree, left = degree + 1;
  }
  return out;
}

template <std::size_t N>
bool solve(const CubicSums& sums, Real unit, Real least_pivot, std::array<Real, N>& x) {
  std::array<Real, 7> powers;
  powers[0] = 1;
  for (std::size_t d = 1; d < 7; ++d) powers[d] = powers[d - 1] / unit;
  const auto moment = scaled(sums.moment, powers, 1);
  const auto height = scaled(sums.height, powers, powers[1]);
  const auto slope_x = scaled(sums.slope_x, powers, 1), slope_y = scaled(sums.slope_y, powers, 1);

  Real a[N][N];
  for (std::size_t r = 0, at = 0; r < N; ++r) {
    for (std::size_t c = 0; c <= r; ++c, ++at) {
      const NormalEntry& e = kNormalTable.matrix[at];
      a[r][c] =
          e.factor[0] * moment[e.moment[0]] + e.factor[1] * moment[e.moment[1]] + e.factor[2] * moment[e.moment[2]];
    }
    const NormalEntry& e = kNormalTable.right[r];
    x[r] = e.factor[0] * height[e.moment[0]] + e.factor[1] * slope_x[e.moment[1]] + e.factor[2] * slope_y[e.moment[2]];
  }

  // LDL^T in place: column c of L below the diagonal, D in `pivot`.
  Real pivot[N], largest = 0, smallest = 0;
  for (std::size_t c = 0; c < N; ++c) {
    Real d = a[c][c];
    Real scaled_row[N];
    for (std::size_t k = 0; k < c; ++k) {
      scaled_row[k] = a[c][k] * pivot[k];
      d -= a[c][k] * scaled_row[k];
    }
    largest = std::max(largest, d);
    smallest = c == 0 ? d : std::min(smallest, d);
    if (!(smallest > least_pivot * largest)) return false;
    pivot[c] = d;
    const Real inverse = 1 / d;
    for (std::size_t r = c + 1; r < N; ++r) {
      Real s = a[r][c];
      for (std::size_t k = 0; k < c; ++k) s -= a[r][k] * scaled_row[k];
      a[r][c] = s * inverse;
    }
  }
  for (std::size_t r = 0; r < N; ++r)
    for (std::size_t c = 0; c < r; ++c) x[r] -= a[r][c] * x[c];
  for (std::size_t r = 0; r < N; ++r) x[r] /= pivot[r];
  for (std::size_t r = N; r-- > 0;)
    for (std::size_t below = r + 1; below < N; ++below) x[r] -= a[below][r] * x[below];
  for (Real value : x)
    if (!std::isfinite(value)) return false;
  return true;
}

template <std::size_t N>
bool solve_into(const CubicSums& sums, Real least_pivot, CubicFit& fit) {
  const Real unit = sums.unit();
  if (!(unit > 0)) return false;
  std::array<Real, N> x;
  if (!solve<N>(sums, unit, least_pivot, x)) return false;
  fit = {};
  for (std::size_t i = 0; i < 3; ++i) fit.b[i] = x[i] / unit;
  if constexpr (N >= 7)
    for (std::size_t i = 0; i < 4; ++i) fit.c[i] = x[3 + i] / (unit * unit);
  if constexpr (N >= 9) fit.gradient = {x[7], x[8]};
  if constexpr (N >= 10) fit.offset = x[9] * unit;
  return true;
}

// Points in the frame. Rejected points have weight 0 and all else 0.
struct FramedPoints {
  const Real *x, *y, *z, *p, *q, *w;
};

// The 28 moments, and those weighted by height and slopes, each as eight partial sums.
INTARSIA_WIDE void accumulate(const FramedPoints& points, std::size_t count, CubicSums& sums) {
  Lanes moment[28] = {}, height[10] = {}, slope_x[6] = {}, slope_y[6] = {};
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Lanes x = lanes_at(points.x + i), y = lanes_at(points.y + i);
    Lanes row[7];  // w x^(degree - j) y^j of the current degree
    row[0] = lanes_at(points.w + i);
    moment[0] += row[0];
    std::size_t at = 1;
    for (std::size_t degree = 1; degree <= 6; ++degree) {
      row[degree] = row[degree - 1] * y;
      for (std::size_t j = 0; j < degree; ++j) row[j] = row[j] * x;
      for (std::size_t j = 0; j <= degree; ++j) moment[at + j] += row[j];
      at += degree + 1;
    }
  }
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Lanes x = lanes_at(points.x + i), y = lanes_at(points.y + i), w = lanes_at(points.w + i);
    const Lanes m[10] = {w,         w * x,         w * y,         w * x * x,     w * x * y,
                         w * y * y, w * x * x * x, w * x * x * y, w * x * y * y, w * y * y * y};
    const Lanes z = lanes_at(points.z + i), p = lanes_at(points.p + i), q = lanes_at(points.q + i);
    for (std::size_t j = 0; j < 10; ++j) height[j] += m[j] * z;
    for (std::size_t j = 0; j < 6; ++j) slope_x[j] += m[j] * p;
    for (std::size_t j = 0; j < 6; ++j) slope_y[j] += m[j] * q;
  }
  for (std::size_t j = 0; j < 28; ++j) sums.moment[j] += sum_of(moment[j]);
  for (std::size_t j = 0; j < 10; ++j) sums.height[j] += sum_of(height[j]);
  for (std::size_t j = 0; j < 6; ++j) sums.slope_x[j] += sum_of(slope_x[j]);
  for (std::size_t j = 0; j < 6; ++j) sums.slope_y[j] += sum_of(slope_y[j]);
}

// Into the frame, in place; returns the number of points accepted.
INTARSIA_WIDE Index into_frame(PointBatch& batch, const Vec3& u, const Vec3& v, const Vec3& n, Real gate, Rows rows,
                               Real& distance) {
  const Real ux = u.x(), uy = u.y(), uz = u.z(), vx = v.x(), vy = v.y(), vz = v.z();
  const Real wx = n.x(), wy = n.y(), wz = n.z();
  const Lanes zero{};
  Lanes accepted{}, far{};
  for (std::size_t i = 0; i < batch.count; i += kLanes) {
    Lanes &dx = lanes_at(batch.x.data() + i), &dy = lanes_at(batch.y.data() + i), &dz = lanes_at(batch.z.data() + i);
    Lanes &nx = lanes_at(batch.nx.data() + i), &ny = lanes_at(batch.ny.data() + i), &nz = lanes_at(batch.nz.data() + i);
    Lanes& weight = lanes_at(batch.weight.data() + i);
    const Lanes c = nx * wx + ny * wy + nz * wz;
    const auto use = c >= gate;
    const Lanes x = dx * ux + dy * uy + dz * uz, y = dx * vx + dy * vy + dz * vz, z = dx * wx + dy * wy + dz * wz;
    const Lanes a = nx * ux + ny * uy + nz * uz, b = nx * vx + ny * vy + nz * vz;
    Lanes length = dx * dx + dy * dy + dz * dz;
    for (std::size_t l = 0; l < kLanes; ++l) length[l] = std::sqrt(length[l]);
    const Lanes level = use ? c : zero + 1.0;
    const Lanes scale = rows == Rows::round ? zero + 1.0 : 1.0 / level;
    const Lanes lift = rows == Rows::round ? (level + 1.0) / 2.0 : zero + 1.0;
    weight = use ? weight : zero;
    accepted += weight > zero ? zero + 1.0 : zero;
    far += weight * length;
    dx = use ? x : zero, dy = use ? y : zero, dz = use ? z * lift : zero;
    nx = use ? -a * scale : zero, ny = use ? -b * scale : zero;
  }
  distance += sum_of(far);
  return static_cast<Index>(sum_of(accepted));
}

}  // namespace

void CubicSums::add(Real x, Real y, Real z, Real p, Real q, Real w, Real d) {
  alignas(64) Real value[6][kLanes] = {{x}, {y}, {z}, {p}, {q}, {w}};
  accumulate({value[0], value[1], value[2], value[3], value[4], value[5]}, kLanes, *this);
  distance += w * d;
  ++count;
}

void add_points(PointBatch& batch, const Vec3& u, const Vec3& v, const Vec3& n, Real gate, Rows rows, CubicSums& sums) {
  const std::size_t whole = whole_lanes(batch.count);
  for (LaneArray* a : {&batch.x, &batch.y, &batch.z, &batch.nx, &batch.ny, &batch.nz, &batch.weight})
    for (std::size_t i = batch.count; i < whole; ++i) a->data()[i] = 0;
  sums.count += into_frame(batch, u, v, n, gate, rows, sums.distance);
  accumulate({batch.x.data(), batch.y.data(), batch.z.data(), batch.nx.data(), batch.ny.data(), batch.weight.data()},
             whole, sums);
}

bool solve_cubic(const CubicSums& sums, std::size_t terms, Real least_pivot, CubicFit& fit) {
  switch (terms) {
    case 3:
      return solve_into<3>(sums, least_pivot, fit);
    case 7:
      return solve_into<7>(sums, least_pivot, fit);
    case 9:
      return solve_into<9>(sums, least_pivot, fit);
    default:
      return solve_into<10>(sums, least_pivot, fit);
  }
}

}  // namespace intarsia::kernels
