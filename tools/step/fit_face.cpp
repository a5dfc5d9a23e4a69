#include "tools/step/fit_face.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace intarsia::tools {
namespace {

constexpr Real kBorderWeight = 30;
constexpr Real kCornerWeight = 3e5;  // of the sample of a cell

Real area_of(const PatchPiece& piece, std::size_t t) {
  const auto& c = piece.triangle[t];
  return (piece.point[c[1]] - piece.point[c[0]]).cross(piece.point[c[2]] - piece.point[c[0]]).norm() / 2;
}

// Corners with half the weight, and middles of equal parts no larger than `spacing` with the rest.
SurfaceSamples inner_samples(const PatchPiece& piece, std::span<const Vec2> uv, Real spacing) {
  SurfaceSamples out;
  std::vector<Real> weight(piece.point.size(), 0);
  for (std::size_t t = 0; t < piece.triangle.size(); ++t)
    for (const Index c : piece.triangle[t]) weight[c] += area_of(piece, t) / 6;
  for (std::size_t i = 0; i < uv.size(); ++i) out.add(uv[i], piece.point[i], weight[i]);
  for (std::size_t t = 0; t < piece.triangle.size(); ++t) {
    const auto& c = piece.triangle[t];
    const Real longest =
        std::max({(uv[c[0]] - uv[c[1]]).norm(), (uv[c[1]] - uv[c[2]]).norm(), (uv[c[2]] - uv[c[0]]).norm()});
    const int n = static_cast<int>(std::clamp(std::ceil(longest / spacing), 1.0, 100.0));
    const Real w = area_of(piece, t) / 2 / (n * n);
    const auto add = [&](Real a, Real b) {  // barycentric, times n
      a /= n, b /= n;
      out.add((1 - a - b) * uv[c[0]] + a * uv[c[1]] + b * uv[c[2]],
              (1 - a - b) * piece.point[c[0]] + a * piece.point[c[1]] + b * piece.point[c[2]], w);
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        add(i + 1.0 / 3, j + 1.0 / 3);
        if (i + j + 1 < n) add(i + 2.0 / 3, j + 2.0 / 3);
      }
  }
  return out;
}

std::vector<BorderGuide> own_border(const PatchPiece& piece, std::span<const Vec2> uv, Real spacing) {
  std::vector<BorderGuide> out;
  for (const PatchPiece::Loop& l : piece.loop)
    for (std::size_t i = 0; i < l.point.size(); ++i) {
      const Index a = l.point[i], b = l.point[(i + 1) % l.point.size()];
      const Real length = (piece.point[b] - piece.point[a]).norm();
      const int n = static_cast<int>(std::clamp(std::ceil((uv[b] - uv[a]).norm() / spacing), 1.0, 1000.0));
      for (int k = 0; k < n; ++k) {
        const Real t = static_cast<Real>(k) / n;
        out.push_back({(1 - t) * uv[a] + t * uv[b], (1 - t) * piece.point[a] + t * piece.point[b], length / n});
      }
    }
  return out;
}

struct Fit {
  SplineSurface surface;
  Real inside = 0, border = 0;
  bool within(const FitLimits& l) const { return inside <= l.inside && border <= l.border; }
  Real excess(const FitLimits& l) const { return std::max(inside / l.inside, border / l.border); }
};

// The first `inner` samples are of the inside, those from `fixed` on keep their parameters.
Fit fit_net(const SplineDomain& domain, SurfaceSamples samples, std::size_t inner, std::size_t fixed) {
  Fit fit;
  FaceSurface face;
  const Real reach = std::max(domain.u_step(), domain.v_step());
  for (int round = 0; round < 2; ++round) {
    face.spline = fit_surface(domain, samples);
    Real inside = 0, border = 0;
    for (std::size_t k = 0; k < fixed; ++k) {
      const Vec2 foot = face.nearest(samples.point[k], samples.uv[k], 3);
      const Real distance = (face.at(foot).point - samples.point[k]).norm();
      (k < inner ? inside : border) = std::max(k < inner ? inside : border, distance);
      if ((foot - samples.uv[k]).norm() < reach) samples.uv[k] = foot;
    }
    if (round == 0 || std::max(inside, border) <= std::max(fit.inside, fit.border)) fit = {face.spline, inside, border};
  }
  return fit;
}

// Nets of growing fineness over one flattening, from `cells` along the longer side.
Fit fit_flattened(const PatchPiece& piece, std::span<const Vec2> uv, std::span<const BorderGuide> guides, Real cells,
                  const FitLimits& limits) {
  Vec2 low = Vec2::Constant(std::numeric_limits<Real>::infinity()), high = -low;
  for (const Vec2& p : uv) low = low.cwiseMin(p), high = high.cwiseMax(p);
  for (const BorderGuide& g : guides) low = low.cwiseMin(g.uv), high = high.cwiseMax(g.uv);
  const Real extent = (high - low).maxCoeff(), margin = 0.02 * extent;
  low.array() -= margin, high.array() += margin;
  Fit best;
  for (bool first = true;; first = false, cells *= 1.5) {
    SplineDomain domain{low, high};
    const Vec2 size = high - low;
    domain.u_spans = std::max(1, static_cast<int>(std::lround(cells * size.x() / extent)));
    domain.v_spans = std::max(1, static_cast<int>(std::lround(cells * size.y() / extent)));
    if (!first && domain.count() > static_cast<std::size_t>(limits.most_control)) break;
    const Real step = std::min(domain.u_step(), domain.v_step());
    SurfaceSamples samples = inner_samples(piece, uv, step / 2);
    const std::size_t inner = samples.size();
    std::vector<BorderGuide> own;
    if (guides.empty()) own = own_border(piece, uv, step / 4);
    for (const BorderGuide& g : guides.empty() ? std::span<const BorderGuide>(own) : guides)
      if (!g.corner) samples.add(g.uv, g.point, kBorderWeight * g.length * step);
    const std::size_t fixed = samples.size();
    for (const BorderGuide& g : guides)
      if (g.corner) samples.add(g.uv, g.point, kCornerWeight * domain.u_step() * domain.v_step());
    Fit fit = fit_net(domain, std::move(samples), inner, fixed);
    if (first || fit.excess(limits) < best.excess(limits)) best = std::move(fit);
    if (best.within(limits)) break;
  }
  return best;
}

bool fit_plane(const PatchPiece& piece, Real limit, FittedFace& face) {
  Vec3 mean = Vec3::Zero(), normal = Vec3::Zero();
  Real all = 0;
  for (std::size_t t = 0; t < piece.triangle.size(); ++t) {
    const auto& c = piece.triangle[t];
    const Real area = area_of(piece, t);
    mean += area * (piece.point[c[0]] + piece.point[c[1]] + piece.point[c[2]]) / 3, all += area;
    normal += (piece.point[c[1]] - piece.point[c[0]]).cross(piece.point[c[2]] - piece.point[c[0]]) / 2;
  }
  if (!(all > 0) || !(normal.norm() > 0.5 * all)) return false;
  mean /= all;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t t = 0; t < piece.triangle.size(); ++t)
    for (const Index c : piece.triangle[t])
      spread += area_of(piece, t) / 3 * (piece.point[c] - mean) * (piece.point[c] - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  Vec3 n = solver.eigenvectors().col(0);
  if (n.dot(normal) < 0) n = -n;
  Real low = 0, high = 0;
  for (const Vec3& p : piece.point) low = std::min(low, n.dot(p - mean)), high = std::max(high, n.dot(p - mean));
  if (high - low > 2 * limit) return false;
  FaceSurface& s = face.surface;
  s.is_plane = true;
  s.origin = mean + (low + high) / 2 * n;
  s.x = solver.eigenvectors().col(2), s.y = n.cross(s.x);
  face.uv.clear();
  for (const Vec3& p : piece.point) face.uv.emplace_back(s.x.dot(p - s.origin), s.y.dot(p - s.origin));
  const TurnedArea turned = turned_area(piece, face.uv);
  if (turned.turned > 1e-4 * turned.all || borders_cross(piece, face.uv)) return false;
  face.done = true;
  face.inside = face.border = (high - low) / 2;
  return true;
}

constexpr Real kFirstCells = 4;

}  // namespace

FittedFace fit_face(const PatchPiece& piece, const FitLimits& limits) {
  FittedFace best;
  if (piece.loop.empty() || !piece.is_flat_in_kind()) {
    best.trouble = piece.loop.empty() ? "it has no border" : "it is neither a disc nor a disc with holes";
    return best;
  }
  FittedFace plane;
  if (fit_plane(piece, limits.plane, plane)) return plane;
  Real excess = 0;
  for (const Flattening kind : {Flattening::projection, Flattening::stretched, Flattening::circle}) {
    FittedFace face;
    face.flattening = kind;
    if (kind == Flattening::projection) {
      face.uv = project(piece);
    } else {
      face.uv = map_to_circle(piece);
      if (kind == Flattening::stretched) face.uv = reduce_distortion(piece, face.uv);
    }
    if (face.uv.empty()) continue;
    align_to_axes(face.uv);
    Fit fit = fit_flattened(piece, face.uv, {}, kFirstCells, limits);
    face.done = true, face.inside = fit.inside, face.border = fit.border;
    const Real over = fit.excess(limits);
    const bool within = fit.within(limits);
    face.surface.is_plane = false, face.surface.spline = std::move(fit.surface);
    if (!best.done || over < excess) best = std::move(face), excess = over;
    if (within) break;
  }
  return best;
}

void fit_again(const PatchPiece& piece, std::span<const BorderGuide> guides, const FitLimits& limits,
               FittedFace& face) {
  if (!face.done || face.surface.is_plane || guides.empty()) return;
  const SplineDomain& d = face.surface.spline.domain;
  const Fit fit = fit_flattened(piece, face.uv, guides, std::max(d.u_spans, d.v_spans), limits);
  face.surface.spline = fit.surface, face.inside = fit.inside, face.border = fit.border;
}

}  // namespace intarsia::tools
