#include "kernels/network/arrange_face.h"

#include <algorithm>
#include <cmath>

namespace intarsia::kernels {
namespace {

constexpr Real kTolerance = 1e-12;  // in reference coordinates; the caller merges points closer than 1e-6

Real orient(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

Real distance2(const PlanePoint& a, const PlanePoint& b) {
  return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v);
}

bool between(const PlanePoint& a, const PlanePoint& b, const PlanePoint& p) {
  if (std::abs(orient(a, b, p)) > kTolerance) return false;
  const Real along = (p.u - a.u) * (b.u - a.u) + (p.v - a.v) * (b.v - a.v);
  return along > kTolerance && along < distance2(a, b) - kTolerance;
}

bool cross_properly(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d) {
  const Real c1 = orient(a, b, c), c2 = orient(a, b, d), c3 = orient(c, d, a), c4 = orient(c, d, b);
  const auto opposite = [](Real x, Real y) {
    return (x > kTolerance && y < -kTolerance) || (x < -kTolerance && y > kTolerance);
  };
  return opposite(c1, c2) && opposite(c3, c4);
}

// Splits segments at points on them and at mutual crossings until nothing is left to split.
void split_segments(FaceArrangement& f) {
  for (std::size_t i = 0; i < f.segment.size(); ++i) {
    for (Index p = 0; p < f.point.size(); ++p) {
      const FaceSegment s = f.segment[i];
      if (p == s.a || p == s.b || !between(f.point[s.a], f.point[s.b], f.point[p])) continue;
      f.segment[i].b = p;
      f.segment.push_back({p, s.b, s.tag});
    }
    for (std::size_t j = 0; j < i; ++j) {
      const FaceSegment s = f.segment[i], t = f.segment[j];
      const PlanePoint &a = f.point[s.a], &b = f.point[s.b], &c = f.point[t.a], &d = f.point[t.b];
      if (!cross_properly(a, b, c, d)) continue;
      const Real r = orient(c, d, a) / (orient(c, d, a) - orient(c, d, b));
      const Index p = static_cast<Index>(f.point.size());
      const PlanePoint at{a.u + r * (b.u - a.u), a.v + r * (b.v - a.v)};
      f.point.push_back(at);
      f.segment[i].b = p;
      f.segment.push_back({p, s.b, s.tag});
      f.segment[j].b = p;
      f.segment.push_back({p, t.b, t.tag});
    }
  }
  std::vector<FaceSegment> kept;
  for (FaceSegment s : f.segment) {
    if (s.a == s.b) continue;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const FaceSegment& k) {
      return (k.a == s.a && k.b == s.b) || (k.a == s.b && k.b == s.a);
    });
    if (!known) kept.push_back(s);
  }
  f.segment.swap(kept);
}

// Ties groups of interior points that no segment joins to the border to it, by the shortest segment that crosses none.
void connect_islands(FaceArrangement& f) {
  const Index n = static_cast<Index>(f.point.size());
  std::vector<std::uint8_t> reached(n, 0);
  std::fill(reached.begin(), reached.begin() + f.boundary, 1);
  for (;;) {
    for (bool grew = true; grew;) {
      grew = false;
      for (const FaceSegment& s : f.segment)
        if (reached[s.a] != reached[s.b]) reached[s.a] = reached[s.b] = 1, grew = true;
    }
    Index best_p = kNone, best_q = kNone;
    Real best = 10;
    for (Index p = f.boundary; p < n; ++p)
      for (Index q = 0; q < n; ++q) {
        if (reached[p] || !reached[q] || distance2(f.point[p], f.point[q]) >= best) continue;
        bool clear = true;
        for (const FaceSegment& s : f.segment)
          clear = clear && !cross_properly(f.point[p], f.point[q], f.point[s.a], f.point[s.b]);
        for (Index r = 0; r < n; ++r)
          clear = clear && (r == p || r == q || !between(f.point[p], f.point[q], f.point[r]));
        if (clear) best = distance2(f.point[p], f.point[q]), best_p = p, best_q = q;
      }
    if (best_p == kNone) return;
    f.segment.push_back({best_p, best_q, kNone});
    reached[best_p] = 1;
  }
}

struct Dart {
  Index from, to;
  bool used;
};

// The polygons that border and segments cut the face into; each is traversed with its inside on the left.
std::vector<std::vector<Index>> trace_polygons(const FaceArrangement& f) {
  std::vector<Dart> dart;
  for (Index i = 0; i < f.boundary; ++i) dart.push_back({i, (i + 1) % f.boundary, false});
  for (const FaceSegment& s : f.segment) dart.push_back({s.a, s.b, false}), dart.push_back({s.b, s.a, false});
  const auto angle = [&](Index from, Index to) {
    return std::atan2(f.point[to].v - f.point[from].v, f.point[to].u - f.point[from].u);
  };
  std::vector<std::vector<Index>> polygon;
  for (std::size_t start = 0; start < dart.size(); ++start) {
    if (dart[start].used) continue;
    polygon.emplace_back();
    for (std::size_t d = start; !dart[d].used;) {
      dart[d].used = true;
      polygon.back().push_back(dart[d].from);
      const Real back = angle(dart[d].to, dart[d].from);
      std::size_t next = start;
      Real smallest = 10;
      for (std::size_t e = 0; e < dart.size(); ++e) {
        if (dart[e].from != dart[d].to) continue;
        Real turn = back - angle(dart[e].from, dart[e].to);  // clockwise from the way back
        if (dart[e].to == dart[d].from) turn = 2 * M_PI;
        while (turn <= 1e-14) turn += 2 * M_PI;
        if (turn < smallest) smallest = turn, next = e;
      }
      d = next;
    }
  }
  return polygon;
}

// Ear clipping, the roundest ear first. Points repeat in polygons around dangling segments; equal ids do not block.
void clip_ears(const FaceArrangement& f, std::vector<Index> polygon, std::vector<std::array<Index, 3>>& triangle) {
  while (polygon.size() > 3) {
    const std::size_t n = polygon.size();
    std::size_t best = n;
    Real best_quality = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Index a = polygon[(i + n - 1) % n], b = polygon[i], c = polygon[(i + 1) % n];
      const PlanePoint &pa = f.point[a], &pb = f.point[b], &pc = f.point[c];
      const Real area = orient(pa, pb, pc);
      if (area <= kTolerance) continue;
      bool clear = true;
      for (std::size_t j = 0; j < n && clear; ++j) {
        const Index q = polygon[j];
        if (q == a || q == b || q == c) continue;
        const PlanePoint& p = f.point[q];
        clear = orient(pa, pb, p) < -kTolerance || orient(pb, pc, p) < -kTolerance || orient(pc, pa, p) < -kTolerance;
      }
      const Real longest = std::max({distance2(pa, pb), distance2(pb, pc), distance2(pc, pa)});
      if (clear && area / longest > best_quality) best_quality = area / longest, best = i;
    }
    if (best == n) break;
    triangle.push_back({polygon[(best + n - 1) % n], polygon[best], polygon[(best + 1) % n]});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(best));
  }
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) triangle.push_back({polygon[0], polygon[i], polygon[i + 1]});
}

}  // namespace

void arrange_face(FaceArrangement& face) {
  split_segments(face);
  connect_islands(face);
  face.triangle.clear();
  for (const auto& polygon : trace_polygons(face))
    if (polygon.size() >= 3) clip_ears(face, polygon, face.triangle);
}

}  // namespace intarsia::kernels
