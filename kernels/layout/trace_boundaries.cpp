#include "kernels/layout/trace_boundaries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/base/error.h"
#include "engine/parallel/compact.h"
#include "engine/parallel/reduce.h"
#include "engine/parallel/sort.h"

namespace intarsia::kernels {
namespace {

enum class KindClass : std::uint8_t { feature, border, free, given };

KindClass class_of(CurveKind k) {
  switch (k) {
    case CurveKind::ridge:
    case CurveKind::valley:
    case CurveKind::sharp:
      return KindClass::feature;
    case CurveKind::border:
      return KindClass::border;
    case CurveKind::given:
      return KindClass::given;
    default:
      return KindClass::free;
  }
}

// The border edges as a small graph of their own; "local" ids count border edges and border vertices in ascending
// order.
struct BorderGraph {
  std::vector<std::uint8_t> is_border;     // per mesh edge
  std::vector<Index> edge, vertex;         // local -> mesh
  std::vector<std::array<Index, 2>> ends;  // local edge -> local vertices
  std::vector<CurveKind> kind;             // per local edge
  std::vector<Real> length;                // per local edge
  Csr incident;                            // local vertex -> local edges, ascending

  Index other(Index e, Index v) const { return ends[e][0] == v ? ends[e][1] : ends[e][0]; }
};

BorderGraph build_border_graph(const Work& work, const RefinedMesh& refined, std::span<const Index> label) {
  const MeshView mesh = refined.mesh.view();
  BorderGraph g;
  g.is_border.resize(mesh.edge_count());
  for_each(work, Cost::light, mesh.edge_count(), [&](std::size_t e) {
    g.is_border[e] = mesh.edge_f1[e] == kNone || label[mesh.edge_f0[e]] != label[mesh.edge_f1[e]];
  });
  g.edge = compact(work, mesh.edge_count(), [&](std::size_t e) { return g.is_border[e] != 0; });
  const std::size_t n = g.edge.size();
  g.kind.resize(n), g.length.resize(n), g.ends.resize(n);
  std::vector<std::pair<Index, Index>> at(2 * n);  // (mesh vertex, local edge)
  for_each(work, Cost::light, n, [&](std::size_t i) {
    const Index e = g.edge[i];
    g.kind[i] = mesh.is_boundary_edge(e) ? CurveKind::border
                : refined.on_network[e]  ? refined.edge_kind[e]
                                         : CurveKind::subdivision;
    g.length[i] = (mesh.point(mesh.edge_v0[e]) - mesh.point(mesh.edge_v1[e])).norm();
    at[2 * i] = {mesh.edge_v0[e], static_cast<Index>(i)};
    at[2 * i + 1] = {mesh.edge_v1[e], static_cast<Index>(i)};
  });
  sort_total(work, at.begin(), at.end());
  g.incident.item.reserve(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (i % 4096 == 0) work.check();
    const auto [v, e] = at[i];
    if (g.vertex.empty() || g.vertex.back() != v) {
      g.vertex.push_back(v);
      g.incident.offset.push_back(static_cast<Index>(i));
    }
    g.incident.item.push_back(e);
    g.ends[e][mesh.edge_v0[g.edge[e]] == v ? 0 : 1] = static_cast<Index>(g.vertex.size() - 1);
  }
  g.incident.offset.push_back(static_cast<Index>(at.size()));
  return g;
}

struct Chains {
  Csr vertex, edge;  // chain -> local vertices, local edges

  Index count() const { return edge.rows(); }
};

// Maximal chains between nodes. Loops without a node get one at their smallest vertex: `artificial` tells which.
Chains trace_chains(const Work& work, const BorderGraph& g, std::vector<std::uint8_t>& node,
                    std::vector<std::uint8_t>& artificial) {
  Chains chains;
  chains.vertex.offset.push_back(0), chains.edge.offset.push_back(0);
  std::vector<std::uint8_t> used(g.edge.size(), 0);
  std::size_t steps = 0;
  const auto walk = [&](Index v, Index e) {
    chains.vertex.item.push_back(v);
    for (;;) {
      if (++steps % 4096 == 0) work.check();
      used[e] = 1;
      chains.edge.item.push_back(e);
      v = g.other(e, v);
      chains.vertex.item.push_back(v);
      if (node[v]) break;
      const auto row = g.incident.row(v);
      e = row[0] == e ? row[1] : row[0];
    }
    chains.vertex.offset.push_back(static_cast<Index>(chains.vertex.item.size()));
    chains.edge.offset.push_back(static_cast<Index>(chains.edge.item.size()));
  };
  const Index n = static_cast<Index>(g.vertex.size());
  for (Index v = 0; v < n; ++v)
    if (node[v])
      for (Index e : g.incident.row(v))
        if (!used[e]) walk(v, e);
  for (Index v = 0; v < n; ++v)
    if (!node[v] && !used[g.incident.row(v)[0]]) {
      node[v] = artificial[v] = 1;
      walk(v, g.incident.row(v)[0]);
    }
  return chains;
}

// One chain of positions, cyclic or not, for measuring turns.
class ChainTurns {
 public:
  ChainTurns(const BorderGraph& g, const MeshView& mesh, const Chains& chains, Index c, bool cyclic)
      : g_(g), mesh_(mesh), vertex_(chains.vertex.row(c)), edge_(chains.edge.row(c)), cyclic_(cyclic) {}

  Index edges() const { return static_cast<Index>(edge_.size()); }
  // First and last (exclusive) vertex at which a corner may sit.
  Index first() const { return cyclic_ ? 0 : 1; }
  Index last() const { return edges(); }

  // Cosine between the chords of the given length before and after vertex i.
  Real cos_turn(Index i, Real chord) const {
    const Vec3 p = point(i), a = p - point(reach(i, chord, false)), b = point(reach(i, chord, true)) - p;
    const Real norm = a.norm() * b.norm();
    return norm > 0 ? a.dot(b) / norm : 1;
  }
  // Calls visit(j) for the vertices within the given distance along the chain, i excluded.
  template <class Visit>
  void near(Index i, Real distance, const Visit& visit) const {
    for (const bool ahead : {false, true}) {
      Real s = 0;
      Index j = i;
      for (Index k = 0; k + 1 < edges(); ++k) {
        if (!cyclic_ && (ahead ? j + 1 >= last() : j <= first())) break;
        s += g_.length[edge_[ahead ? j : before(j)]];
        if (s > distance) break;
        j = ahead ? after(j) : before(j);
        visit(j);
      }
    }
  }
  Index vertex(Index i) const { return vertex_[i]; }

 private:
  Vec3 point(Index i) const { return mesh_.point(g_.vertex[vertex_[i]]); }
  Index after(Index i) const { return cyclic_ && i + 1 == edges() ? 0 : i + 1; }
  Index before(Index i) const { return i == 0 ? edges() - 1 : i - 1; }
  Index reach(Index i, Real chord, bool ahead) const {
    Real s = 0;
    Index j = i;
    const Index most = std::max<Index>(1, cyclic_ ? edges() / 2 : edges());  // never round the loop
    for (Index k = 0; k < most && s < chord; ++k) {
      if (!cyclic_ && (ahead ? j == edges() : j == 0)) break;
      s += g_.length[edge_[ahead ? j : before(j)]];
      j = ahead ? after(j) : before(j);
    }
    return j;
  }

  const BorderGraph& g_;
  const MeshView& mesh_;
  std::span<const Index> vertex_, edge_;
  bool cyclic_;
};

// Marks the corners of feature and border chains. A corner turns both over the long chord and over one edge: the second
// test keeps small smooth loops (a hole of sixteen edges turns 67 degrees over three) free of corners.
void mark_corners(const Work& work, const BorderGraph& g, const MeshView& mesh, const Chains& chains, Real mean_edge,
                  const TraceOptions& options, const std::vector<std::uint8_t>& artificial,
                  std::vector<std::uint8_t>& corner) {
  const Real degree = std::numbers::pi / 180;
  const Real limit = std::cos(options.corner_angle * degree),
             local_limit = std::cos(options.corner_angle * 5 / 6 * degree);
  const Real chord = options.corner_chord * mean_edge;
  for_each(work, Cost::single, chains.count(), [&](std::size_t c) {
    if (class_of(g.kind[chains.edge.row(static_cast<Index>(c))[0]]) == KindClass::free) return;
    const auto row = chains.vertex.row(static_cast<Index>(c));
    const ChainTurns chain(g, mesh, chains, static_cast<Index>(c),
                           row.front() == row.back() && artificial[row.front()]);
    std::vector<Real> turn(chain.edges() + 1, 2);  // cosine; 2 = no corner
    for (Index i = chain.first(); i < chain.last(); ++i) {
      if (i % 4096 == 0 && work.cancelled()) return;
      const Real t = chain.cos_turn(i, chord);
      if (t < limit && chain.cos_turn(i, mean_edge) < local_limit) turn[i] = t;
    }
    for (Index i = chain.first(); i < chain.last(); ++i) {
      if (turn[i] > 1) continue;
      bool best = true;
      chain.near(i, chord, [&](Index j) {
        const Real own = chain.cos_turn(i, mean_edge), its = turn[j] > 1 ? 2 : chain.cos_turn(j, mean_edge);
        if (its < own || (its == own && chain.vertex(j) < chain.vertex(i))) best = false;
      });
      if (best) corner[chain.vertex(i)] = 1;
    }
  });
}

// The face that has the border edge `e` on its rim in the direction that leaves vertex v; kNone outside the mesh.
Index left_face(const MeshView& mesh, Index e, Index v) {
  const Index f = mesh.edge_f0[e];
  const int i = mesh.corner_of(f, v);
  return mesh.corner[3 * f + (i + 1) % 3] == mesh.other_vertex(e, v) ? f : mesh.edge_f1[e];
}

void describe_arcs(const Work& work, const BorderGraph& g, const RefinedMesh& refined, std::span<const Index> label,
                   const Chains& chains, LayoutGraph& out) {
  const MeshView mesh = refined.mesh.view();
  const Index n = chains.count();
  out.arc.offset = chains.vertex.offset, out.arc_edges.offset = chains.edge.offset;
  out.arc.item.resize(chains.vertex.item.size()), out.arc_edges.item.resize(chains.edge.item.size());
  out.start.resize(n), out.end.resize(n), out.kind.resize(n), out.strength.resize(n);
  out.left.resize(n), out.right.resize(n), out.length.resize(n);
  const auto node_of = [&](Index v) {
    return static_cast<Index>(std::lower_bound(out.node.begin(), out.node.end(), v) - out.node.begin());
  };
  const auto patch_of = [&](Index f) { return f == kNone ? kNone : label[f]; };
  for_each(work, Cost::heavy, n, [&](std::size_t c) {
    const auto vertices = chains.vertex.row(static_cast<Index>(c)), edges = chains.edge.row(static_cast<Index>(c));
    for (std::size_t i = 0; i < vertices.size(); ++i) out.arc.item[out.arc.offset[c] + i] = g.vertex[vertices[i]];
    std::array<Real, kCurveKinds> by_kind{};
    Real length = 0, strength = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Index e = g.edge[edges[i]];
      out.arc_edges.item[out.arc_edges.offset[c] + i] = e;
      by_kind[static_cast<std::size_t>(g.kind[edges[i]])] += g.length[edges[i]];
      length += g.length[edges[i]];
      if (refined.on_network[e]) strength += g.length[edges[i]] * refined.edge_strength[e];
    }
    out.length[c] = length;
    out.strength[c] = length > 0 ? strength / length : 0;
    out.kind[c] = length > 0
                      ? static_cast<CurveKind>(std::max_element(by_kind.begin(), by_kind.end()) - by_kind.begin())
                      : g.kind[edges[0]];
    out.start[c] = node_of(g.vertex[vertices.front()]), out.end[c] = node_of(g.vertex[vertices.back()]);
    const Index e = g.edge[edges[0]];
    out.left[c] = patch_of(left_face(mesh, e, g.vertex[vertices[0]]));
    out.right[c] = patch_of(left_face(mesh, e, g.vertex[vertices[1]]));
  });
}

void trace_loops(const Work& work, const BorderGraph& g, const MeshView& mesh, Index patch_count, LayoutGraph& out) {
  const Index half_arcs = 2 * out.arc_count();
  std::vector<Index> arc_of(g.edge.size(), kNone);  // local edge at the end of an arc -> arc
  const auto local = [&](Index e) {
    return static_cast<std::size_t>(std::lower_bound(g.edge.begin(), g.edge.end(), e) - g.edge.begin());
  };
  for (Index a = 0; a < out.arc_count(); ++a) {
    arc_of[local(out.arc_edges.row(a).front())] = a;
    arc_of[local(out.arc_edges.row(a).back())] = a;
  }
  // Rotates around the end of half-arc h inside its patch until the next border edge: right at pinch vertices too.
  std::vector<Index> next(half_arcs, kNone);
  for_each(work, Cost::heavy, half_arcs, [&](std::size_t h) {
    const Index a = static_cast<Index>(h / 2);
    if (out.patch_of_half_arc(static_cast<Index>(h)) == kNone) return;
    const auto vertices = out.arc.row(a), edges = out.arc_edges.row(a);
    const Index v = h % 2 ? vertices.front() : vertices.back();
    const Index from = h % 2 ? vertices[1] : vertices[vertices.size() - 2];
    Index f = left_face(mesh, h % 2 ? edges.front() : edges.back(), from);
    for (std::size_t turns = mesh.vertex_faces.row(v).size() + 1; turns > 0 && f != kNone; --turns) {
      const int i = mesh.corner_of(f, v);
      const Index e = mesh.face_edge[3 * f + (i + 2) % 3];
      if (g.is_border[e]) {
        const Index b = arc_of[local(e)];
        if (b == kNone) break;
        const bool forward = out.arc_edges.row(b).front() == e && out.arc.row(b).front() == v;
        next[h] = 2 * b + (forward ? 0 : 1);
        return;
      }
      f = mesh.other_face(e, f);
    }
    throw Error(ErrorCode::internal, "a patch border does not close", v);
  });
  std::vector<std::pair<Index, Index>> order;  // (patch, smallest half-arc)
  std::vector<std::uint8_t> seen(half_arcs, 0);
  for (Index h = 0; h < half_arcs; ++h) {
    if (next[h] == kNone || seen[h]) continue;
    order.emplace_back(out.patch_of_half_arc(h), h);
    for (Index k = h; !seen[k]; k = next[k]) seen[k] = 1;
  }
  std::sort(order.begin(), order.end());
  out.loop.offset.push_back(0);
  out.patch_loops.offset.assign(std::size_t{patch_count} + 1, 0);
  for (const auto& [patch, first] : order) {
    Index h = first;
    do {
      out.loop.item.push_back(h);
      h = next[h];
    } while (h != first);
    out.loop.offset.push_back(static_cast<Index>(out.loop.item.size()));
    out.patch_loops.item.push_back(static_cast<Index>(out.loop_patch.size()));
    out.loop_patch.push_back(patch);
    ++out.patch_loops.offset[std::size_t{patch} + 1];
  }
  for (Index p = 0; p < patch_count; ++p) out.patch_loops.offset[p + 1] += out.patch_loops.offset[p];
}

}  // namespace

LayoutGraph trace_boundaries(const Work& work, const RefinedMesh& refined, std::span<const Index> label,
                             Index patch_count, const TraceOptions& options) {
  const MeshView mesh = refined.mesh.view();
  if (label.size() != mesh.face_count())
    throw Error(ErrorCode::internal, "trace_boundaries needs one label per refined face");
  const BorderGraph g = build_border_graph(work, refined, label);
  std::vector<std::uint8_t> node(g.vertex.size());
  for_each(work, Cost::light, g.vertex.size(), [&](std::size_t v) {
    const auto row = g.incident.row(static_cast<Index>(v));
    node[v] = row.size() != 2 || class_of(g.kind[row[0]]) != class_of(g.kind[row[1]]);
  });
  std::vector<std::uint8_t> artificial(g.vertex.size(), 0);
  Chains chains;
  {
    std::vector<std::uint8_t> with_loops = node;
    chains = trace_chains(work, g, with_loops, artificial);
    const Real total = sum(work, Cost::light, mesh.edge_count(), Real{0}, [&](std::size_t e) {
      return (mesh.point(mesh.edge_v0[e]) - mesh.point(mesh.edge_v1[e])).norm();
    });
    const Real mean_edge = mesh.edge_count() ? total / mesh.edge_count() : 0;
    mark_corners(work, g, mesh, chains, mean_edge, options, artificial, node);
  }
  std::fill(artificial.begin(), artificial.end(), std::uint8_t{0});
  trace_chains(work, g, node, artificial);  // finds which loops are still without a node
  std::vector<std::uint8_t> none(g.vertex.size(), 0);
  chains = trace_chains(work, g, node, none);

  LayoutGraph out;
  for (Index v = 0; v < node.size(); ++v)
    if (node[v]) out.node.push_back(g.vertex[v]), out.artificial.push_back(artificial[v]);
  describe_arcs(work, g, refined, label, chains, out);
  trace_loops(work, g, mesh, patch_count, out);
  return out;
}

}  // namespace intarsia::kernels
