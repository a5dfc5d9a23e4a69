#include "tools/step/flatten.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/SparseCholesky>

#include "engine/base/error.h"

namespace intarsia::tools {
namespace {

Real cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

Real side_of(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

// Proper crossings only: touching ends do not count.
bool segments_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Real p = side_of(a, b, c), q = side_of(a, b, d), r = side_of(c, d, a), s = side_of(c, d, b);
  return ((p > 0 && q < 0) || (p < 0 && q > 0)) && ((r > 0 && s < 0) || (r < 0 && s > 0));
}

struct Segment {
  Vec2 a, b;
};

Real cotangent(const Vec3& at, const Vec3& a, const Vec3& b) {
  const Vec3 u = a - at, v = b - at;
  const Real area = u.cross(v).norm(), dot = u.dot(v);
  return area > 1e-3 * std::abs(dot) ? dot / area : (dot > 0 ? 1e3 : -1e3);
}

}  // namespace

TurnedArea turned_area(const PatchPiece& piece, std::span<const Vec2> uv) {
  TurnedArea sum;
  for (const auto& t : piece.triangle) {
    const Real area = side_of(uv[t[0]], uv[t[1]], uv[t[2]]) / 2;
    sum.all += std::abs(area);
    if (area < 0) sum.turned -= area;
  }
  return sum;
}

bool borders_cross(const PatchPiece& piece, std::span<const Vec2> uv) {
  std::vector<Segment> segment;
  for (const PatchPiece::Loop& l : piece.loop)
    for (std::size_t i = 0; i < l.point.size(); ++i)
      segment.push_back({uv[l.point[i]], uv[l.point[(i + 1) % l.point.size()]]});
  // Sweep along x.
  std::vector<std::pair<Real, std::size_t>> order;
  for (std::size_t i = 0; i < segment.size(); ++i) order.emplace_back(std::min(segment[i].a.x(), segment[i].b.x()), i);
  std::sort(order.begin(), order.end());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Segment& s = segment[order[k].second];
    const Real high = std::max(s.a.x(), s.b.x());
    for (std::size_t m = k + 1; m < order.size() && order[m].first <= high; ++m) {
      const Segment& o = segment[order[m].second];
      if (segments_cross(s.a, s.b, o.a, o.b)) return true;
    }
  }
  return false;
}

void align_to_axes(std::vector<Vec2>& uv) {
  Real least = std::numeric_limits<Real>::infinity(), chosen = 0;
  for (int degree = 0; degree < 90; ++degree) {
    const Real angle = degree * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    Vec2 low = Vec2::Constant(std::numeric_limits<Real>::infinity()), high = -low;
    for (const Vec2& p : uv) {
      const Vec2 q(c * p.x() - s * p.y(), s * p.x() + c * p.y());
      low = low.cwiseMin(q), high = high.cwiseMax(q);
    }
    const Real area = (high - low).prod();
    if (area < least * (1 - 1e-9)) least = area, chosen = angle;
  }
  const Real c = std::cos(chosen), s = std::sin(chosen);
  for (Vec2& p : uv) p = {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
}

std::vector<Vec2> project(const PatchPiece& piece) {
  Vec3 sum = Vec3::Zero();
  Real area = 0;
  std::vector<Vec3> normal;
  for (const auto& t : piece.triangle) {
    normal.push_back((piece.point[t[1]] - piece.point[t[0]]).cross(piece.point[t[2]] - piece.point[t[0]]));
    sum += normal.back(), area += normal.back().norm();
  }
  if (!(sum.norm() > 0.5 * area)) return {};
  const Vec3 n = sum.normalized();
  Real steep = 0;
  for (const Vec3& m : normal)
    if (m.dot(n) < 0.5 * m.norm()) steep += m.norm();
  if (steep > 1e-3 * area) return {};
  const Vec3 x = n.unitOrthogonal(), y = n.cross(x);
  std::vector<Vec2> uv;
  for (const Vec3& p : piece.point) uv.emplace_back(x.dot(p), y.dot(p));
  const TurnedArea turned = turned_area(piece, uv);
  if (turned.turned > 1e-5 * turned.all || borders_cross(piece, uv)) return {};
  return uv;
}

std::vector<Vec2> map_to_circle(const PatchPiece& piece) {
  // Holes become discs with a point in the middle.
  const std::size_t own = piece.point.size(), fans = piece.loop.size() - 1, n = own + fans;
  std::vector<Vec3> point = piece.point;
  std::vector<std::array<Index, 3>> triangle = piece.triangle;
  for (std::size_t l = 1; l < piece.loop.size(); ++l) {
    const auto& loop = piece.loop[l].point;
    Vec3 mean = Vec3::Zero();
    for (const Index i : loop) mean += piece.point[i] / static_cast<Real>(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i)
      triangle.push_back({loop[(i + 1) % loop.size()], loop[i], static_cast<Index>(point.size())});
    point.push_back(mean);
  }
  Real area = 0;
  for (const auto& t : piece.triangle) area += (point[t[1]] - point[t[0]]).cross(point[t[2]] - point[t[0]]).norm() / 2;
  std::vector<Vec2> uv(n, Vec2::Zero());
  std::vector<Index> row(n, 0);
  const PatchPiece::Loop& outer = piece.loop[0];
  const Real radius = std::sqrt(std::max(area, 1e-300) / std::numbers::pi),
             count = static_cast<Real>(outer.point.size());
  Real at = 0;
  for (std::size_t i = 0; i < outer.point.size(); ++i) {
    const Real angle = 2 * std::numbers::pi * at;
    uv[outer.point[i]] = radius * Vec2(std::cos(angle), std::sin(angle));
    row[outer.point[i]] = kNone;
    const Vec3 step = point[outer.point[(i + 1) % outer.point.size()]] - point[outer.point[i]];
    at += 0.95 * step.norm() / outer.length + 0.05 / count;  // no two points at one place
  }
  Index inner = 0;
  for (Index& r : row)
    if (r != kNone) r = inner++;
  if (inner > 0) {
    using Sparse = Eigen::SparseMatrix<Real>;
    std::vector<Eigen::Triplet<Real, int>> entries;
    Eigen::Matrix<Real, Eigen::Dynamic, 2> right(inner, 2);
    right.setZero();
    for (const auto& t : triangle)
      for (int i = 0; i < 3; ++i) {
        const Index a = t[(i + 1) % 3], b = t[(i + 2) % 3];
        const Real w = std::clamp(cotangent(point[t[i]], point[a], point[b]), 0.05, 20.0);
        for (const auto& [p, q] : {std::pair(a, b), std::pair(b, a)}) {
          if (row[p] == kNone) continue;
          entries.emplace_back(row[p], row[p], w);
          if (row[q] == kNone)
            right.row(row[p]) += w * uv[q].transpose();
          else
            entries.emplace_back(row[p], row[q], -w);
        }
      }
    Sparse matrix(inner, inner);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::SimplicialLDLT<Sparse> solver(matrix);
    if (solver.info() != Eigen::Success) throw Error(ErrorCode::numeric, "a patch could not be flattened");
    const auto solved = solver.solve(right).eval();
    for (std::size_t i = 0; i < n; ++i)
      if (row[i] != kNone) uv[i] = solved.row(row[i]).transpose();
  }
  uv.resize(own);
  return uv;
}

}  // namespace intarsia::tools
