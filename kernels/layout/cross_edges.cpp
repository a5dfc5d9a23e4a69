#include "kernels/layout/cross_edges.h"

#include <algorithm>
#include <utility>

#include "engine/base/error.h"
#include "engine/parallel/for_each.h"
#include "engine/parallel/sort.h"
#include "engine/space/surface_path.h"
#include "kernels/layout/curve_conflicts.h"

namespace intarsia::kernels {
namespace {

// How much of the smoothing an arc still has.
enum class Level : std::uint8_t { snapped, crossed, chain };

struct Token {
  SurfacePoint at;
  bool anchor = false;  // a node or a fixed point: never dropped
};
using Path = std::vector<Token>;

bool same_place(const Token& a, const Token& b) {
  return a.at.kind == b.at.kind && a.at.element == b.at.element && a.at.kind == PointKind::vertex;
}

// A crossing of an edge that the neighbouring token already lies on: the path may leave it out.
bool is_spoke_of(const MeshView& mesh, const Token& crossing, const Token& neighbour) {
  if (crossing.anchor || crossing.at.kind != PointKind::edge) return false;
  const Index e = crossing.at.element;
  switch (neighbour.at.kind) {
    case PointKind::vertex:
      return mesh.edge_v0[e] == neighbour.at.element || mesh.edge_v1[e] == neighbour.at.element;
    case PointKind::edge:
      return neighbour.at.element == e;
    case PointKind::face:
      return false;
  }
  return false;
}

// Appends a token and pulls the path tight: an edge crossed back and forth, a crossing beside a vertex that is on the
// path anyway, and repeated vertices go.
void push_tight(const MeshView& mesh, Path& path, const Token& t) {
  if (!path.empty() && !t.anchor) {
    const Token& top = path.back();
    if (same_place(top, t)) return;
    if (is_spoke_of(mesh, t, top)) {
      if (!top.anchor && top.at.kind == PointKind::edge) path.pop_back();
      return;
    }
  }
  while (!path.empty() && !path.back().anchor && (same_place(path.back(), t) || is_spoke_of(mesh, path.back(), t)))
    path.pop_back();
  path.push_back(t);
}

// The same across the seam of a closed path without anchors at its seam.
void tighten_seam(const MeshView& mesh, Path& path) {
  std::size_t first = 0, last = path.size();
  while (last - first >= 2) {
    const Token &head = path[first], &tail = path[last - 1];
    const bool head_spoke = is_spoke_of(mesh, head, tail), tail_spoke = is_spoke_of(mesh, tail, head);
    if (head_spoke && tail_spoke)
      ++first, --last;  // one edge, back and forth
    else if (head_spoke)
      ++first;
    else if (tail_spoke || (!tail.anchor && same_place(head, tail)))
      --last;
    else
      break;
  }
  path.erase(path.begin() + static_cast<std::ptrdiff_t>(last), path.end());
  path.erase(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(first));
}

// The ways of one layout: paths of all arcs at their present level.
class Crossing {
 public:
  Crossing(const Work& work, const MeshView& mesh, const RefinedMesh& refined, const LayoutGraph& graph,
           const SmoothedArcs& smoothed, std::span<const std::uint8_t> keep_chain, const CrossOptions& options)
      : work_(work),
        mesh_(mesh),
        refined_(refined),
        graph_(graph),
        smoothed_(smoothed),
        options_(options),
        level_(graph.arc_count(), Level::snapped),
        chain_only_(graph.arc_count(), 0),
        node_back_(graph.node_count(), 0),
        path_(graph.arc_count()),
        shown_(graph.arc_count()),
        stale_(graph.arc_count(), 1) {
    for (Index a = 0; a < graph.arc_count(); ++a) {
      const Index n = smoothed.offset[a + 1] - smoothed.offset[a];
      bool fixed = smoothed.node_fixed[graph.start[a]] && smoothed.node_fixed[graph.end[a]];
      for (Index i = smoothed.offset[a]; fixed && i < smoothed.offset[a] + n; ++i) fixed = smoothed.fixed[i] != 0;
      if (fixed || (!keep_chain.empty() && keep_chain[a])) chain_only_[a] = 1, put_back(a);
    }
    for (Index n = 0; n < graph.node_count(); ++n) node_back_[n] |= smoothed.node_fixed[n];
  }

  CrossedArcs run() {
    for (;;) {
      lay_paths();
      if (put_back_failures()) continue;
      CrossedArcs out = assemble();
      if (!resolve(find_conflicts(work_, mesh_, out.network, {options_.min_gap}))) {
        out.as_traced.resize(graph_.arc_count());
        for (Index a = 0; a < graph_.arc_count(); ++a) {
          out.as_traced[a] = level_[a] == Level::chain;
          out.reverted += out.as_traced[a] && !chain_only_[a];
        }
        return out;
      }
    }
  }

 private:
  // An artificial node of a free loop is only a point of it and disappears among the crossings.
  bool floats(Index a) const {
    return graph_.artificial[graph_.start[a]] && !node_back_[graph_.start[a]] && level_[a] != Level::chain;
  }
  SurfacePoint node_at(Index n) const { return node_back_[n] ? refined_.origin[graph_.node[n]] : smoothed_.node[n]; }

  void put_back(Index a) {
    level_[a] = Level::chain;
    stale_[a] = 1;
    for (Index n : {graph_.start[a], graph_.end[a]}) {
      if (node_back_[n]) continue;
      node_back_[n] = 1;
      moved_back_.push_back(n);
    }
  }

  void lay_paths() {
    if (!moved_back_.empty()) {  // arcs that end in a node put back must reach it there
      for (Index a = 0; a < graph_.arc_count(); ++a)
        for (Index n : moved_back_) stale_[a] |= graph_.start[a] == n || graph_.end[a] == n;
      moved_back_.clear();
    }
    failed_.assign(graph_.arc_count(), 0);
    for_each(work_, Cost::single, graph_.arc_count(), [&](std::size_t a) {
      if (!stale_[a]) return;
      path_[a].clear();
      failed_[a] = !lay_path(static_cast<Index>(a), path_[a]);
    });
    find_blocked();
    for_each(work_, Cost::single, graph_.arc_count(), [&](std::size_t a) { snap(static_cast<Index>(a)); });
    std::fill(stale_.begin(), stale_.end(), std::uint8_t{0});
  }

  bool lay_path(Index a, Path& path) const {
    if (level_[a] == Level::chain) {
      for (Index v : graph_.arc.row(a)) path.push_back({refined_.origin[v], true});
      return true;
    }
    const bool loose = floats(a);
    Token last{node_at(graph_.start[a]), !loose};
    if (!loose) path.push_back(last);
    std::vector<SurfacePoint> crossings;
    const auto go_to = [&](const Token& t) {
      crossings.clear();
      if (!section_crossings(mesh_, last.at, t.at, options_.margin, crossings)) return false;
      for (const SurfacePoint& x : crossings) push_tight(mesh_, path, {x, false});
      if (t.anchor) push_tight(mesh_, path, t);
      last = t;
      return true;
    };
    for (Index i = smoothed_.offset[a]; i < smoothed_.offset[a + 1]; ++i)
      if (!go_to({smoothed_.point[i], smoothed_.fixed[i] != 0})) return false;
    if (!go_to({node_at(graph_.end[a]), !loose})) return false;
    if (loose) tighten_seam(mesh_, path);
    return is_sound(a, path);
  }

  bool is_sound(Index a, const Path& path) const {
    const bool loose = floats(a);
    if (loose ? path.size() < 3 : path.size() < (graph_.is_closed(a) ? 4u : 2u)) return false;
    for (std::size_t i = loose ? 0 : 1; i < path.size(); ++i) {
      const Token& before = i ? path[i - 1] : path.back();
      if (shared_faces(mesh_, before.at, path[i].at)[0] == kNone) return false;
    }
    return true;
  }

  bool put_back_failures() {
    bool any = false;
    for (Index a = 0; a < graph_.arc_count(); ++a)
      if (failed_[a] && level_[a] != Level::chain) put_back(a), any = true;
    return any;
  }

  // Vertices that no crossing may snap to: those with an anchor, and those that two arcs come near.
  void find_blocked() {
    std::vector<std::pair<Index, Index>> near;  // (vertex, arc)
    blocked_.clear();
    for (Index a = 0; a < graph_.arc_count(); ++a)
      for (const Token& t : path_[a]) {
        if (t.at.kind == PointKind::vertex) blocked_.push_back(t.at.element);
        if (t.at.kind == PointKind::edge) near.emplace_back(near_end(t.at), a);
      }
    sort_total(work_, near.begin(), near.end());
    for (std::size_t i = 1; i < near.size(); ++i)
      if (near[i].first == near[i - 1].first && near[i].second != near[i - 1].second) blocked_.push_back(near[i].first);
    sort_total(work_, blocked_.begin(), blocked_.end());
  }

  Index near_end(const SurfacePoint& p) const {
    return p.a < 0.5 ? mesh_.edge_v0[p.element] : mesh_.edge_v1[p.element];
  }

  void snap(Index a) {
    shown_[a] = path_[a];
    if (level_[a] != Level::snapped) return;
    Path tight;
    for (Token t : path_[a]) {
      if (!t.anchor && t.at.kind == PointKind::edge && std::min(t.at.a, 1 - t.at.a) < options_.snap) {
        const Index v = near_end(t.at);
        if (!std::binary_search(blocked_.begin(), blocked_.end(), v)) t.at = SurfacePoint::at_vertex(v);
      }
      push_tight(mesh_, tight, t);
    }
    if (floats(a)) tighten_seam(mesh_, tight);
    if (is_sound(a, tight)) shown_[a] = std::move(tight);
  }

  // The turn angle at a refined vertex of an arc: mean of the arc's edges there.
  Real strength_at(Index a, std::size_t i) const {
    const auto edges = graph_.arc_edges.row(a);
    const auto of = [&](Index e) { return refined_.on_network[e] ? refined_.edge_strength[e] : Real{0}; };
    return (of(edges[i > 0 ? i - 1 : 0]) + of(edges[std::min(i, edges.size() - 1)])) / 2;
  }

  CrossedArcs assemble() const {
    CrossedArcs out;
    CurveNetwork& net = out.network;
    std::vector<Index> point_of(graph_.node_count(), kNone);
    net.curve.offset.push_back(0);
    for (Index a = 0; a < graph_.arc_count(); ++a) {
      if (floats(a)) continue;
      for (Index n : {graph_.start[a], graph_.end[a]}) {
        if (point_of[n] == kNone) {
          point_of[n] = static_cast<Index>(net.point.size());
          net.point.push_back(node_at(n));
          net.strength.push_back(0);
        }
        Real& s = net.strength[point_of[n]];
        s = std::max(s, strength_at(a, n == graph_.start[a] ? 0 : graph_.arc_edges.row(a).size()));
      }
    }
    for (Index a = 0; a < graph_.arc_count(); ++a) {
      work_.check();
      const Path& path = shown_[a];
      const bool loose = floats(a);
      const std::size_t edges = graph_.arc_edges.row(a).size();
      const Index first = static_cast<Index>(net.point.size());
      for (std::size_t i = 0; i < path.size(); ++i) {
        if (!loose && (i == 0 || i + 1 == path.size())) {
          net.curve.item.push_back(point_of[i == 0 ? graph_.start[a] : graph_.end[a]]);
          continue;
        }
        // Smoothing keeps the order along the arc, so the same share of the way finds the strength.
        net.curve.item.push_back(static_cast<Index>(net.point.size()));
        net.point.push_back(path[i].at);
        net.strength.push_back(
            strength_at(a, (2 * i * edges + path.size() - 1) / (2 * (path.size() - (loose ? 0 : 1)))));
      }
      if (loose) net.curve.item.push_back(first);
      net.curve.offset.push_back(static_cast<Index>(net.curve.item.size()));
      net.kind.push_back(graph_.kind[a]);
    }
    return out;
  }

  // Takes one level of smoothing from every arc in conflict; false if there is nothing to take.
  bool resolve(const std::vector<std::pair<Index, Index>>& conflicts) {
    std::vector<Index> arcs;
    for (const auto& [a, b] : conflicts) arcs.push_back(a), arcs.push_back(b);
    std::sort(arcs.begin(), arcs.end());
    arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
    bool any = false;
    for (Index a : arcs) {
      if (level_[a] == Level::chain) continue;
      any = true;
      if (level_[a] == Level::snapped && !same_points(shown_[a], path_[a]))
        level_[a] = Level::crossed;
      else
        put_back(a);
    }
    return any;
  }

  static bool same_points(const Path& p, const Path& q) {
    return std::equal(p.begin(), p.end(), q.begin(), q.end(),
                      [](const Token& a, const Token& b) { return a.at == b.at; });
  }

  const Work& work_;
  const MeshView& mesh_;
  const RefinedMesh& refined_;
  const LayoutGraph& graph_;
  const SmoothedArcs& smoothed_;
  const CrossOptions& options_;
  std::vector<Level> level_;
  std::vector<std::uint8_t> chain_only_, node_back_;
  std::vector<Path> path_, shown_;  // before and after snapping
  std::vector<std::uint8_t> stale_, failed_;
  std::vector<Index> moved_back_, blocked_;
};

}  // namespace

CrossedArcs cross_edges(const Work& work, MeshView original, const RefinedMesh& refined, const LayoutGraph& graph,
                        const SmoothedArcs& smoothed, std::span<const std::uint8_t> keep_chain,
                        const CrossOptions& options) {
  if (smoothed.offset.size() != std::size_t{graph.arc_count()} + 1 || smoothed.node.size() != graph.node_count() ||
      (!keep_chain.empty() && keep_chain.size() != graph.arc_count()))
    throw Error(ErrorCode::internal, "cross_edges needs the smoothed points of the same graph");
  return Crossing(work, original, refined, graph, smoothed, keep_chain, options).run();
}

}  // namespace intarsia::kernels
