#include "tools/step/shared_edges.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "engine/parallel/for_each.h"

namespace intarsia::tools {
namespace {

constexpr int kLeastSamples = 24;

// Where a half-arc is in its patch.
struct Place {
  Index patch = kNone;
  std::size_t loop = 0, side = 0;
};

std::vector<Place> places_of(const FittedLayout& layout) {
  std::vector<Place> place(2 * std::size_t{layout.graph->arc_count()});
  for (Index p = 0; p < layout.piece.size(); ++p)
    for (std::size_t l = 0; l < layout.piece[p].loop.size(); ++l)
      for (std::size_t s = 0; s < layout.piece[p].loop[l].side.size(); ++s)
        place[layout.piece[p].loop[l].side[s].half_arc] = {p, l, s};
  return place;
}

// A point with a first guess of its place on a face.
struct OnFace {
  const FaceSurface* surface;
  Vec2 uv;
};

Vec3 where_faces_meet(const Vec3& start, std::vector<OnFace>& on, Real most, int rounds = 8) {
  constexpr Real kDamping = 0.05;
  Vec3 x = start;
  for (int round = 0; round < rounds; ++round) {
    Eigen::Matrix3d matrix = kDamping * Eigen::Matrix3d::Identity();
    Vec3 right = Vec3::Zero();
    for (OnFace& f : on) {
      f.uv = f.surface->nearest(x, f.uv, 4);
      const SurfacePointAndSlopes s = f.surface->at(f.uv);
      const Vec3 normal = s.u.cross(s.v).normalized();
      if (!normal.allFinite()) continue;
      matrix += normal * normal.transpose();
      right += normal * normal.dot(s.point - x);
    }
    x += matrix.inverse() * right;
  }
  const Real moved = (x - start).norm();
  return moved > most ? Vec3(start + most / moved * (x - start)) : x;
}

// Points of an arc, with a few between its vertices, and their places on the faces at its sides.
struct ArcSamples {
  std::vector<Real> t;
  std::vector<Vec3> point;
  std::array<std::vector<Vec2>, 2> uv;  // left, right; empty where there is no face
};

ArcSamples sample(const FittedLayout& layout, const std::vector<Place>& place, Index arc, int least) {
  ArcSamples out;
  std::array<const FittedFace*, 2> face = {nullptr, nullptr};
  std::array<std::vector<Index>, 2> along;
  std::vector<Vec3> point;
  for (int k = 0; k < 2; ++k) {
    const Place& p = place[2 * arc + k];
    if (p.patch == kNone || !layout.face[p.patch].done) continue;
    const PatchPiece& piece = layout.piece[p.patch];
    face[k] = &layout.face[p.patch];
    along[k] = piece.side_points(piece.loop[p.loop], p.side);
    if (k == 1) std::reverse(along[k].begin(), along[k].end());
    point.clear();
    for (const Index i : along[k]) point.push_back(piece.point[i]);
  }
  if (point.empty()) return out;
  Real length = 0;
  for (std::size_t i = 1; i < point.size(); ++i) length += (point[i] - point[i - 1]).norm();
  const auto add = [&](std::size_t i, Real s) {
    out.point.push_back((1 - s) * point[i] + s * point[i + (s > 0 ? 1 : 0)]);
    for (int k = 0; k < 2; ++k)
      if (face[k]) {
        const auto& uv = face[k]->uv;
        out.uv[k].push_back(s > 0 ? Vec2((1 - s) * uv[along[k][i]] + s * uv[along[k][i + 1]]) : uv[along[k][i]]);
      }
  };
  for (std::size_t i = 0; i + 1 < point.size(); ++i) {
    const Real step = (point[i + 1] - point[i]).norm();
    const int n = std::max(3, static_cast<int>(std::ceil(step / length * least)));
    for (int m = 0; m < n; ++m) add(i, static_cast<Real>(m) / n);
  }
  add(point.size() - 1, 0);
  return out;
}

void measure_along(ArcSamples& samples) {
  samples.t.assign(samples.point.size(), 0);
  for (std::size_t i = 1; i < samples.point.size(); ++i)
    samples.t[i] = samples.t[i - 1] + std::max((samples.point[i] - samples.point[i - 1]).norm(), 1e-12);
}

template <class Point>
Real farthest(const SplineCurve<Point>& curve, std::span<const Real> t, std::span<const Point> point) {
  Real most = 0;
  for (std::size_t i = 0; i < t.size(); ++i) most = std::max(most, (curve.at(t[i]) - point[i]).norm());
  return most;
}

// At equal steps along the points.
ArcSamples even(const ArcSamples& samples, int steps) {
  ArcSamples out;
  std::size_t at = 0;
  for (int i = 0; i <= steps; ++i) {
    const Real t = samples.t.back() * i / steps;
    while (at + 2 < samples.t.size() && samples.t[at + 1] < t) ++at;
    const Real s = std::clamp((t - samples.t[at]) / (samples.t[at + 1] - samples.t[at]), 0.0, 1.0);
    out.t.push_back(t), out.point.push_back((1 - s) * samples.point[at] + s * samples.point[at + 1]);
  }
  return out;
}

// More spans until the points are met; never more spans than points.
CadEdge fit_edge(const ArcSamples& samples, Real limit) {
  CadEdge edge;
  const Vec3 &a = samples.point.front(), &b = samples.point.back();
  const Vec3 way = (b - a).normalized();
  Real bent = 0;
  for (const Vec3& p : samples.point) {
    const Real s = std::clamp((p - a).dot(way), 0.0, (b - a).norm());
    bent = std::max(bent, (p - a - s * way).norm());
  }
  if (bent <= 0.05 * limit) {
    edge.is_line = true, edge.deviation = bent;
    edge.curve.length = (b - a).norm();
    for (int i = -1; i <= 2; ++i) edge.curve.control.push_back(a + i * (b - a));
    return edge;
  }
  const int most = static_cast<int>(samples.t.size());
  for (int spans = 1;; spans = std::min(most, spans + (spans + 1) / 2)) {
    const ArcSamples steps = even(samples, std::max(8 * spans, kLeastSamples));
    edge.curve = fit_curve(steps.t, std::span<const Vec3>(steps.point), spans);
    edge.deviation = std::max(farthest<Vec3>(edge.curve, steps.t, steps.point),
                              farthest<Vec3>(edge.curve, samples.t, samples.point));
    if (edge.deviation <= limit || spans >= most) return edge;
  }
}

// Parameters at which a curve is looked at, both ends included.
std::vector<Real> parameters(const CadEdge& edge, int least) {
  const int n = std::max(least, 6 * edge.curve.spans());
  std::vector<Real> t(n + 1);
  for (int i = 0; i <= n; ++i) t[i] = edge.curve.length * i / n;
  return t;
}

// Feet of the edge's points on a face, begun at the places that the arc's own points have there.
std::vector<Vec2> feet(const FaceSurface& surface, const CadEdge& edge, std::span<const Real> t,
                       const ArcSamples& samples, int side) {
  std::vector<Vec2> out;
  std::size_t at = 0;
  const auto& uv = samples.uv[side];
  const Real scale = samples.t.back() / edge.curve.length;
  for (const Real x : t) {
    const Real y = x * scale;
    while (at + 2 < samples.t.size() && samples.t[at + 1] < y) ++at;
    const Real s = std::clamp((y - samples.t[at]) / (samples.t[at + 1] - samples.t[at]), 0.0, 1.0);
    out.push_back(surface.nearest(edge.curve.at(x), (1 - s) * uv[at] + s * uv[at + 1], 8));
  }
  return out;
}

}  // namespace

void share_edges(const Work& work, const FittedLayout& layout, const EdgeLimits& limits, const EdgeFreedom& freedom,
                 CadModel& model) {
  const LayoutGraph& graph = *layout.graph;
  const std::vector<Place> place = places_of(layout);
  model.vertex.resize(graph.node_count());
  model.edge.resize(graph.arc_count());
  // Corners: every half-arc tells its start.
  std::vector<std::vector<OnFace>> around(graph.node_count());
  std::vector<Vec3> node_point(graph.node_count(), Vec3::Zero());
  std::vector<std::uint8_t> stale(graph.node_count(), 0);
  for (Index h = 0; h < place.size(); ++h) {
    if (place[h].patch == kNone || !layout.face[place[h].patch].done) continue;
    const PatchPiece& piece = layout.piece[place[h].patch];
    const FittedFace& face = layout.face[place[h].patch];
    const PatchPiece::Loop& loop = piece.loop[place[h].loop];
    const Index i = loop.point[loop.side[place[h].side].begin];
    const Index node = h % 2 ? graph.end[h / 2] : graph.start[h / 2];
    around[node].push_back({&face.surface, face.uv[i]});
    node_point[node] = piece.point[i];
  }
  // A node moves once only: what ends there and is not stale stays.
  for (Index a = 0; a < graph.arc_count(); ++a)
    if (freedom.stale[a])
      for (const Index n : {graph.start[a], graph.end[a]}) stale[n] = 1;
  for (Index a = 0; a < graph.arc_count(); ++a)
    if (!freedom.stale[a])
      for (const Index n : {graph.start[a], graph.end[a]}) stale[n] = 0;
  for_each(work, Cost::heavy, around.size(), [&](std::size_t n) {
    if (around[n].empty() || !stale[n]) return;
    model.vertex[n].point =
        freedom.node[n] == Freedom::none ? node_point[n] : where_faces_meet(node_point[n], around[n], limits.move, 40);
  });
  for_each(work, Cost::single, graph.arc_count(), [&](std::size_t i) {
    const Index arc = static_cast<Index>(i);
    if (!freedom.stale[arc]) return;
    CadEdge& edge = model.edge[arc];
    edge.start = graph.start[arc], edge.end = graph.end[arc];
    ArcSamples samples = sample(layout, place, arc, kLeastSamples);
    if (samples.point.empty()) return;
    measure_along(samples);
    const std::vector<Real> along = samples.t;
    const Vec3 at_start = model.vertex[edge.start].point - samples.point.front();
    const Vec3 at_end = model.vertex[edge.end].point - samples.point.back();
    const Real reach = std::min(4 * limits.move, along.back() / 2);
    for (std::size_t k = 0; k < samples.point.size(); ++k) {
      // 1 at the end, 0 where the arc is on its own.
      const Real s = 1 - std::min(along[k], reach) / reach, e = 1 - std::min(along.back() - along[k], reach) / reach;
      Vec3 moved = Vec3::Zero();
      if (freedom.arc[arc] == Freedom::full) {
        std::vector<OnFace> on;
        for (int side = 0; side < 2; ++side)
          if (!samples.uv[side].empty())
            on.push_back({&layout.face[place[2 * arc + side].patch].surface, samples.uv[side][k]});
        moved = where_faces_meet(samples.point[k], on, limits.move) - samples.point[k];
      }
      samples.point[k] += s * at_start + e * at_end + (1 - s) * (1 - e) * moved;
    }
    measure_along(samples);
    edge = fit_edge(samples, freedom.arc[arc] == Freedom::full ? limits.curve : 0.1 * limits.curve);
    edge.start = graph.start[arc], edge.end = graph.end[arc];
  });
}

namespace {

// The corners of a loop on the patch's face: each is one place, whichever of its two sides it is seen from. Beside a
// polyline it is where the flattening has it.
std::vector<Vec2> corners_of(const FittedLayout& layout, const EdgeFreedom& freedom, const CadModel& model, Index patch,
                             const PatchPiece::Loop& loop) {
  const auto is_polyline = [&](const PatchPiece::Side& s) { return freedom.arc[s.half_arc / 2] == Freedom::polyline; };
  std::vector<Vec2> corner;
  for (std::size_t i = 0; i < loop.side.size(); ++i) {
    const PatchPiece::Side& s = loop.side[i];
    const Index node = s.half_arc % 2 ? layout.graph->end[s.half_arc / 2] : layout.graph->start[s.half_arc / 2];
    const Vec2 flat = layout.face[patch].uv[loop.point[s.begin]];
    const bool stiff = is_polyline(s) || is_polyline(loop.side[(i + loop.side.size() - 1) % loop.side.size()]);
    corner.push_back(stiff ? flat : layout.face[patch].surface.nearest(model.vertex[node].point, flat, 12));
  }
  return corner;
}

}  // namespace

std::vector<BorderGuide> guides_of(const FittedLayout& layout, const EdgeFreedom& freedom, const CadModel& model,
                                   Index patch) {
  const std::vector<Place> place = places_of(layout);
  std::vector<BorderGuide> out;
  const PatchPiece& piece = layout.piece[patch];
  for (const PatchPiece::Loop& loop : piece.loop) {
    const std::vector<Vec2> corner = corners_of(layout, freedom, model, patch, loop);
    for (std::size_t i = 0; i < corner.size(); ++i) {
      const Index half = loop.side[i].half_arc;
      const Index node = half % 2 ? layout.graph->end[half / 2] : layout.graph->start[half / 2];
      out.push_back({corner[i], model.vertex[node].point, 0, true});
    }
    for (const PatchPiece::Side& s : loop.side) {
      const Index arc = s.half_arc / 2;
      const CadEdge& edge = model.edge[arc];
      ArcSamples samples = sample(layout, place, arc, kLeastSamples);
      measure_along(samples);
      const std::vector<Real> t = parameters(edge, 48);
      const std::vector<Vec2> uv = feet(layout.face[patch].surface, edge, t, samples, s.half_arc % 2);
      for (std::size_t k = 0; k < t.size(); ++k)
        out.push_back({uv[k], edge.curve.at(t[k]), edge.curve.length / static_cast<Real>(t.size())});
    }
  }
  return out;
}

namespace {

// Whether the ends of the edge, seen on a plane, are the corners at which the face has them.
bool corners_agree(const CadEdge& edge, const FaceSurface& plane, bool forward, std::span<const Vec2> corner,
                   std::size_t side) {
  const Vec2 &from = corner[side], &to = corner[(side + 1) % corner.size()];
  const Vec2 a = plane.nearest(edge.curve.at(0), from), b = plane.nearest(edge.curve.at(edge.curve.length), to);
  return (a - (forward ? from : to)).norm() + (b - (forward ? to : from)).norm() < 1e-9;
}

}  // namespace

void add_faces(const Work& work, const FittedLayout& layout, const EdgeLimits& limits, const EdgeFreedom& freedom,
               CadModel& model) {
  const std::vector<Place> place = places_of(layout);
  std::vector<Real> gap(place.size(), 0), end_gap(place.size(), 0);
  std::vector<CadFace> face(layout.piece.size());
  for_each(work, Cost::single, layout.piece.size(), [&](std::size_t p) {
    if (!layout.face[p].done) return;
    face[p].patch = static_cast<Index>(p);
    face[p].surface = layout.face[p].surface;
    const FaceSurface& surface = face[p].surface;
    for (const PatchPiece::Loop& loop : layout.piece[p].loop) {
      std::vector<CadSide> sides;
      const std::vector<Vec2> corner = corners_of(layout, freedom, model, static_cast<Index>(p), loop);
      for (std::size_t i = 0; i < loop.side.size(); ++i) {
        const Index half = loop.side[i].half_arc;
        const CadEdge& edge = model.edge[half / 2];
        CadSide side{half / 2, half % 2 == 0, {}, {}, {}};
        std::vector<Real> t = parameters(edge, 48);
        if (freedom.arc[half / 2] == Freedom::polyline) {
          ArcSamples samples = sample(layout, place, half / 2, kLeastSamples);
          measure_along(samples);
          const Real scale = edge.curve.length / samples.t.back();
          for (std::size_t k = 0; k < samples.t.size(); ++k) {
            side.knot.push_back(k + 1 == samples.t.size() ? edge.curve.length : scale * samples.t[k]);
            side.corner.push_back(samples.uv[half % 2][k]);
          }
        } else if (surface.is_plane && corners_agree(edge, surface, side.forward, corner, i)) {
          side.curve.length = edge.curve.length;
          for (const Vec3& c : edge.curve.control) side.curve.control.push_back(surface.nearest(c, Vec2::Zero()));
        } else {
          ArcSamples samples = sample(layout, place, half / 2, kLeastSamples);
          measure_along(samples);
          std::vector<Vec2> uv = feet(surface, edge, t, samples, half % 2);
          const Vec2 &from = corner[i], &to = corner[(i + 1) % corner.size()];
          uv.front() = side.forward ? from : to, uv.back() = side.forward ? to : from;
          Real least = 0;  // no curve on the face can be nearer
          for (std::size_t k = 0; k < t.size(); ++k)
            least = std::max(least, (surface.at(uv[k]).point - edge.curve.at(t[k])).norm());
          const int most = static_cast<int>(t.size()) / 2;
          for (int spans = std::max(2, edge.curve.spans());; spans = std::min(most, 2 * spans)) {
            side.curve = fit_curve(t, std::span<const Vec2>(uv), std::min(spans, most));
            Real worst = 0;
            for (const Real x : t) worst = std::max(worst, (surface.at(side.at(x)).point - edge.curve.at(x)).norm());
            if (worst <= least + 0.2 * limits.curve || spans >= most) break;
          }
        }
        const int fine = 4 * static_cast<int>(t.size());
        for (int k = 0; k <= fine; ++k) {
          const Real x = edge.curve.length * k / fine;
          gap[half] = std::max(gap[half], (surface.at(side.at(x)).point - edge.curve.at(x)).norm());
        }
        end_gap[half] = std::max((surface.at(side.at(0)).point - model.vertex[edge.start].point).norm(),
                                 (surface.at(side.at(edge.curve.length)).point - model.vertex[edge.end].point).norm());
        sides.push_back(std::move(side));
      }
      face[p].loops.push_back(std::move(sides));
    }
  });
  for (CadEdge& e : model.edge) e.tolerance = 0;
  for (CadVertex& v : model.vertex) v.tolerance = v.gap = 0;
  for (Index h = 0; h < place.size(); ++h) {
    CadEdge& edge = model.edge[h / 2];
    edge.tolerance = std::max(edge.tolerance, gap[h]);
    for (CadVertex* v : {&model.vertex[edge.start], &model.vertex[edge.end]})
      v->tolerance = std::max(v->tolerance, edge.tolerance), v->gap = std::max(v->gap, end_gap[h]);
  }
  model.face.clear();
  for (CadFace& f : face)
    if (!f.loops.empty()) model.face.push_back(std::move(f));
}

}  // namespace intarsia::tools
