// Images of arcs on a face that cross: found on polylines, cured by letting the arcs move less.
#include <algorithm>

#include "engine/parallel/for_each.h"
#include "tools/step/shared_edges.h"

namespace intarsia::tools {
namespace {

struct Piece {
  Vec2 a, b;
  Index edge;
  std::size_t next;  // the piece that begins where this one ends
};

Real side_of(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool cross(const Piece& s, const Piece& o) {
  const Real p = side_of(s.a, s.b, o.a), q = side_of(s.a, s.b, o.b);
  const Real r = side_of(o.a, o.b, s.a), t = side_of(o.a, o.b, s.b);
  return ((p > 0 && q < 0) || (p < 0 && q > 0)) && ((r > 0 && t < 0) || (r < 0 && t > 0));
}

// The edges of a face whose images cross each other or themselves, ascending.
std::vector<Index> crossing_edges(const CadFace& face) {
  std::vector<Piece> piece;
  for (const auto& loop : face.loops) {
    const std::size_t first = piece.size();
    for (const CadSide& side : loop) {
      std::vector<Vec2> point = side.corner;
      if (point.empty()) {
        const int n = std::max(24, 8 * side.curve.spans());
        for (int i = 0; i <= n; ++i) point.push_back(side.curve.at(side.curve.length * i / n));
      }
      if (!side.forward) std::reverse(point.begin(), point.end());
      for (std::size_t i = 1; i < point.size(); ++i)
        piece.push_back({point[i - 1], point[i], side.edge, piece.size() + 1});
    }
    if (piece.size() > first) piece.back().next = first;
  }
  std::vector<std::pair<Real, std::size_t>> order;
  for (std::size_t i = 0; i < piece.size(); ++i) order.emplace_back(std::min(piece[i].a.x(), piece[i].b.x()), i);
  std::sort(order.begin(), order.end());
  std::vector<Index> found;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Piece& s = piece[order[k].second];
    const Real high = std::max(s.a.x(), s.b.x());
    for (std::size_t m = k + 1; m < order.size() && order[m].first <= high; ++m) {
      const Piece& o = piece[order[m].second];
      // Pieces that meet in a point do not cross there, whatever rounding makes of it.
      if (s.next == order[m].second || o.next == order[k].second) continue;
      if (cross(s, o)) found.push_back(s.edge), found.push_back(o.edge);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace

Index stiffen_crossings(const Work& work, const CadModel& model, EdgeFreedom& freedom) {
  std::vector<std::vector<Index>> found(model.face.size());
  for_each(work, Cost::single, found.size(), [&](std::size_t f) { found[f] = crossing_edges(model.face[f]); });
  std::fill(freedom.stale.begin(), freedom.stale.end(), 0);
  Index faces = 0;
  for (const auto& edges : found) {
    faces += edges.empty() ? 0 : 1;
    for (const Index e : edges) {
      if (freedom.stale[e]) continue;
      freedom.stale[e] = 1;
      if (freedom.arc[e] == Freedom::full) {
        freedom.arc[e] = Freedom::ends_only;
      } else if (freedom.arc[e] == Freedom::none) {
        freedom.arc[e] = Freedom::polyline;
      } else {
        freedom.arc[e] = std::max(freedom.arc[e], Freedom::none);
        for (const Index n : {model.edge[e].start, model.edge[e].end}) freedom.node[n] = Freedom::none;
      }
    }
  }
  // What ends in a node that moves back has to follow.
  for (std::size_t e = 0; e < model.edge.size(); ++e)
    for (const Index n : {model.edge[e].start, model.edge[e].end})
      if (freedom.node[n] == Freedom::none) freedom.stale[e] = faces > 0 ? 1 : freedom.stale[e];
  return faces;
}

}  // namespace intarsia::tools
