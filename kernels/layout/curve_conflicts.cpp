#include "kernels/layout/curve_conflicts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "engine/parallel/build_csr.h"
#include "engine/parallel/sort.h"
#include "engine/space/surface_path.h"

namespace intarsia::kernels {
namespace {

using Pair = std::pair<Index, Index>;
using Pairs = std::vector<Pair>;

constexpr Real kTouch = 1e-9;  // in barycentric units

Pair ordered(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

struct Segment {
  Index curve, p, q;
};

// A point as one face sees it: on the rim (a parameter in [0, 3), corner i at i) or inside.
struct InFace {
  bool rim = false;
  Real at = 0;
  int side = -1;  // rim points inside an edge: the corner that starts it
  Real x = 0, y = 0;
};

InFace seen_in(const MeshView& mesh, const SurfacePoint& p, Index f) {
  InFace r;
  const auto w = weights_in_face(mesh, p, f);
  r.x = w[0], r.y = w[1];
  if (p.kind == PointKind::face) return r;
  r.rim = true;
  if (p.kind == PointKind::vertex) {
    r.at = mesh.corner_of(f, p.element);
    return r;
  }
  for (int i = 0; i < 3; ++i)
    if (mesh.face_edge[3 * f + i] == p.element) r.side = (i + 1) % 3;
  r.at = r.side + (mesh.edge_v0[p.element] == mesh.corner[3 * f + r.side] ? p.a : 1 - p.a);
  return r;
}

// The side of the face that contains both rim points, or -1.
int common_side(const InFace& a, const InFace& b) {
  const auto on = [](const InFace& p, int s) {
    return p.side >= 0 ? p.side == s : static_cast<int>(p.at) == s || static_cast<int>(p.at) == (s + 1) % 3;
  };
  for (int s = 0; s < 3; ++s)
    if (on(a, s) && on(b, s)) return s;
  return -1;
}

// Position along side s, 0 .. 1.
Real along_side(const InFace& p, int s) { return p.side >= 0 ? p.at - s : static_cast<int>(p.at) == s ? 0 : 1; }

Real turn(const InFace& a, const InFace& b, const InFace& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// True if c lies on the segment a b.
bool touches(const InFace& a, const InFace& b, const InFace& c) {
  const Real dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
  if (!(length2 > 0)) return false;
  const Real t = std::clamp(((c.x - a.x) * dx + (c.y - a.y) * dy) / length2, Real{0}, Real{1});
  return std::hypot(c.x - a.x - t * dx, c.y - a.y - t * dy) <= kTouch;
}

bool cross(const InFace& a, const InFace& b, const InFace& c, const InFace& d) {
  if (a.rim && b.rim && c.rim && d.rim) {
    const int s = common_side(a, b), t = common_side(c, d);
    if (s >= 0 && s == t) {
      const Real a0 = along_side(a, s), b0 = along_side(b, s), c0 = along_side(c, s), d0 = along_side(d, s);
      return std::max(std::min(a0, b0), std::min(c0, d0)) <= std::min(std::max(a0, b0), std::max(c0, d0));
    }
    // A chord of the rim separates c from d iff exactly one of them lies between its ends. A chord that runs along a
    // side has only points of that side between its ends, or, the other way round, everything else.
    const Real low = std::min(a.at, b.at), high = std::max(a.at, b.at);
    const auto between = [&](const InFace& p) { return low < p.at && p.at < high; };
    return between(c) != between(d);
  }
  const Real o1 = turn(a, b, c), o2 = turn(a, b, d), o3 = turn(c, d, a), o4 = turn(c, d, b);
  if ((o1 > 0) != (o2 > 0) && (o3 > 0) != (o4 > 0)) return true;
  return touches(a, b, c) || touches(a, b, d) || touches(c, d, a) || touches(c, d, b);
}

// Two segments from a common point: do they overlap?
bool overlap(const InFace& common, const InFace& x, const InFace& y) {
  if (common.rim && x.rim && y.rim) {
    const int s = common_side(common, x);
    if (s < 0 || s != common_side(common, y)) return false;
    if (common_side(x, y) != s) return false;
    const Real c = along_side(common, s);
    return (along_side(x, s) > c) == (along_side(y, s) > c);
  }
  return touches(common, x, y) || touches(common, y, x);
}

void check_points(const Work& work, const CurveNetwork& network, const CsrView& curves_of, Real min_gap, Pairs& found) {
  std::vector<Index> used;
  for (Index i = 0; i < network.point.size(); ++i)
    if (!curves_of.row(i).empty()) used.push_back(i);
  const auto key = [&](Index i) {
    const SurfacePoint& p = network.point[i];
    return std::tuple(p.kind, p.element, p.a, p.b, i);
  };
  sort_total(work, used.begin(), used.end(), [&](Index a, Index b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < used.size(); ++i) {
    if (i % 4096 == 0) work.check();
    const SurfacePoint &p = network.point[used[i - 1]], &q = network.point[used[i]];
    if (p.kind != q.kind || p.element != q.element) continue;
    if (p.kind == PointKind::edge && q.a - p.a >= min_gap) continue;
    if (p.kind == PointKind::face && std::hypot(q.a - p.a, q.b - p.b) > kTouch) continue;
    for (Index c : curves_of.row(used[i - 1]))
      for (Index d : curves_of.row(used[i])) found.push_back(ordered(c, d));
  }
}

}  // namespace

std::vector<std::pair<Index, Index>> find_conflicts(const Work& work, MeshView mesh, const CurveNetwork& network,
                                                    const ConflictOptions& options) {
  std::vector<Segment> segment;
  std::vector<Index> curve_of;
  segment.reserve(network.curve.item.size()), curve_of.reserve(network.curve.item.size());
  for (Index c = 0; c < network.curve_count(); ++c) {
    const auto row = network.curve.row(c);
    for (std::size_t i = 0; i < row.size(); ++i) curve_of.push_back(c);
    for (std::size_t i = 1; i < row.size(); ++i) segment.push_back({c, row[i - 1], row[i]});
  }
  const Csr curves_of = build_csr(
      work, static_cast<Index>(network.point.size()), network.curve.item.size(),
      [&](std::size_t i) { return network.curve.item[i]; }, [&](std::size_t i) { return curve_of[i]; });
  Pairs found;
  check_points(work, network, curves_of, options.min_gap, found);

  std::vector<std::pair<Index, Index>> in_face(2 * segment.size());  // (face, segment)
  for_each(work, Cost::medium, segment.size(), [&](std::size_t s) {
    const auto faces = shared_faces(mesh, network.point[segment[s].p], network.point[segment[s].q]);
    in_face[2 * s] = {faces[0], static_cast<Index>(s)};
    in_face[2 * s + 1] = {faces[1], static_cast<Index>(s)};
  });
  for (std::size_t s = 0; s < segment.size(); ++s)
    if (in_face[2 * s].first == kNone || segment[s].p == segment[s].q)
      found.emplace_back(segment[s].curve, segment[s].curve);
  sort_total(work, in_face.begin(), in_face.end());
  std::vector<Index> group;  // starts of runs with one face
  for (std::size_t i = 0; i < in_face.size() && in_face[i].first != kNone; ++i)
    if (i == 0 || in_face[i].first != in_face[i - 1].first) group.push_back(static_cast<Index>(i));

  std::vector<Pairs> by_block(block_count(Cost::medium, group.size()));
  for_each_block(work, Cost::medium, group.size(), [&](std::size_t begin, std::size_t end, std::size_t block) {
    std::vector<std::array<InFace, 2>> ends;
    for (std::size_t g = begin; g < end; ++g) {
      const Index first = group[g], f = in_face[first].first;
      Index last = first;
      while (last < in_face.size() && in_face[last].first == f) ++last;
      if (last - first < 2) continue;
      ends.clear();
      for (Index i = first; i < last; ++i) {
        const Segment& s = segment[in_face[i].second];
        ends.push_back({seen_in(mesh, network.point[s.p], f), seen_in(mesh, network.point[s.q], f)});
      }
      for (Index i = first; i < last; ++i)
        for (Index j = i + 1; j < last; ++j) {
          const Segment &s = segment[in_face[i].second], &t = segment[in_face[j].second];
          const auto &u = ends[i - first], &v = ends[j - first];
          bool bad;
          if (s.p == t.p)
            bad = s.q == t.q || overlap(u[0], u[1], v[1]);
          else if (s.p == t.q)
            bad = s.q == t.p || overlap(u[0], u[1], v[0]);
          else if (s.q == t.p)
            bad = overlap(u[1], u[0], v[1]);
          else if (s.q == t.q)
            bad = overlap(u[1], u[0], v[0]);
          else
            bad = cross(u[0], u[1], v[0], v[1]);
          if (bad) by_block[block].push_back(ordered(s.curve, t.curve));
        }
    }
  });
  for (const Pairs& p : by_block) found.insert(found.end(), p.begin(), p.end());
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace intarsia::kernels
