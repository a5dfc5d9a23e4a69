#include "kernels/layout/smooth_boundaries.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "engine/base/error.h"
#include "engine/parallel/reduce.h"
#include "engine/space/surface_path.h"
#include "kernels/layout/label_sums.h"

namespace intarsia::kernels {
namespace {

using Mat3 = Eigen::Matrix3d;

constexpr Real kInside = 1e-3;  // smallest weight of a point that moved: keeps plane sections generic

// Mean edges: a patch of a few faces leaves less room than this, and its border is better left alone, because curves
// are cut off inside faces (cross_edges).
constexpr Real kLeastRoom = 0.2;

enum class Direction : std::uint8_t { t_min, t_max };

constexpr Real kCreaseCosine = 0.5;  // 60 degrees, as sharp_edges has it

// All points in one array: nodes first, then the inner points of the arcs.
struct Points {
  Index nodes = 0;
  std::vector<FacePoint> at;
  std::vector<Vec3> position, start;
  std::vector<Real> reach;           // 0 = fixed
  std::vector<Index> arc;            // of an inner point
  std::vector<Index> before, after;  // of an inner point: neighbours in the flat array
  Csr spokes;                        // node -> neighbouring points
};

// The direction across X at a point, J X, scaled so that its squared length is the confidence.
Vec3 across(const MeshView& mesh, const PrincipalLines& lines, const FacePoint& p, Direction choice) {
  if (lines.vertex_count() == 0) return Vec3::Zero();
  const auto& line = choice == Direction::t_max ? lines.tmax : lines.tmin;
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    const Index v = mesh.corner[3 * p.face + i];
    const Real w = p.weight[i] * lines.confidence[v];
    const Vec3 x(line[0][v], line[1][v], line[2][v]);
    mean += mean.dot(x) < 0 ? Vec3(-w * x) : Vec3(w * x);  // lines, not arrows
  }
  Vec3 n = area_normal(mesh, p.face);
  const Real size = n.norm();
  if (!(size > 0)) return Vec3::Zero();
  n /= size;
  const Vec3 j = n.cross(mean);
  const Real length = j.norm();
  return length > 0 && std::isfinite(length) ? Vec3(j / std::sqrt(length)) : Vec3(Vec3::Zero());
}

Real mean_edge_at(const MeshView& mesh, const SurfacePoint& p) {
  Real sum = 0;
  int n = 0;
  const auto add = [&](Index f) {
    if (f == kNone) return;
    const auto [i, j, k] = mesh.face(f);
    sum += (mesh.point(i) - mesh.point(j)).norm() + (mesh.point(j) - mesh.point(k)).norm() +
           (mesh.point(k) - mesh.point(i)).norm();
    n += 3;
  };
  switch (p.kind) {
    case PointKind::vertex:
      for (Index f : mesh.vertex_faces.row(p.element)) add(f);
      break;
    case PointKind::edge:
      add(mesh.edge_f0[p.element]), add(mesh.edge_f1[p.element]);
      break;
    case PointKind::face:
      add(p.element);
      break;
  }
  return n ? sum / n : 0;
}

// 2 area / perimeter of every patch; a patch without border has no limit.
std::vector<Real> patch_widths(const Work& work, const RefinedMesh& refined, std::span<const Index> label,
                               const LayoutGraph& graph) {
  const MeshView mesh = refined.mesh.view();
  std::vector<Real> width = sum_by_label<Real>(
      work, mesh.face_count(), graph.patch_count(), [&](std::size_t f) { return label[f]; },
      [&](std::size_t f) { return area_normal(mesh, static_cast<Index>(f)).norm(); });  // twice the area
  for (Index p = 0; p < graph.patch_count(); ++p) {
    Real perimeter = 0;
    for (Index l : graph.patch_loops.row(p))
      for (Index h : graph.loop.row(l)) perimeter += graph.length[h / 2];
    width[p] = perimeter > 0 ? width[p] / perimeter : std::numeric_limits<Real>::infinity();
  }
  return width;
}

Points collect_points(const Work& work, const MeshView& original, const RefinedMesh& refined, const LayoutGraph& graph,
                      const std::vector<Index>& offset) {
  Points p;
  p.nodes = graph.node_count();
  const std::size_t n = p.nodes + offset.back();
  p.at.resize(n), p.position.resize(n), p.reach.assign(n, 0);
  p.arc.assign(n, kNone), p.before.assign(n, kNone), p.after.assign(n, kNone);
  for_each(work, Cost::light, p.nodes,
           [&](std::size_t i) { p.at[i] = to_face_point(original, refined.origin[graph.node[i]]); });
  for_each(work, Cost::heavy, graph.arc_count(), [&](std::size_t arc) {
    const Index a = static_cast<Index>(arc);
    const auto vertices = graph.arc.row(a);
    const Index first = p.nodes + offset[a], last = p.nodes + offset[a + 1];  // exclusive
    for (Index i = first; i < last; ++i) {
      p.at[i] = to_face_point(original, refined.origin[vertices[i - first + 1]]);
      p.arc[i] = a;
      p.before[i] = i == first ? graph.start[a] : i - 1;
      p.after[i] = i + 1 == last ? graph.end[a] : i + 1;
    }
  });
  for_each(work, Cost::light, n, [&](std::size_t i) { p.position[i] = position(original, p.at[i]); });
  p.start = p.position;
  // Spokes in arc order; a closed arc gives its node two.
  p.spokes.offset.assign(std::size_t{p.nodes} + 1, 0);
  for (Index a = 0; a < graph.arc_count(); ++a)
    ++p.spokes.offset[graph.start[a] + 1], ++p.spokes.offset[graph.end[a] + 1];
  for (Index i = 0; i < p.nodes; ++i) p.spokes.offset[i + 1] += p.spokes.offset[i];
  p.spokes.item.resize(p.spokes.offset.back());
  std::vector<Index> cursor(p.spokes.offset.begin(), p.spokes.offset.end() - 1);
  for (Index a = 0; a < graph.arc_count(); ++a) {
    const Index first = p.nodes + offset[a], last = p.nodes + offset[a + 1];
    p.spokes.item[cursor[graph.start[a]]++] = first == last ? graph.end[a] : first;
    p.spokes.item[cursor[graph.end[a]]++] = first == last ? graph.start[a] : last - 1;
  }
  return p;
}

// Is this edge a crease, whether or not the network knows it?
bool turns(const MeshView& mesh, Index e) {
  if (mesh.is_boundary_edge(e)) return false;
  const Vec3 a = area_normal(mesh, mesh.edge_f0[e]), b = area_normal(mesh, mesh.edge_f1[e]);
  return a.dot(b) < kCreaseCosine * a.norm() * b.norm();
}

bool is_feature(CurveKind k) { return k == CurveKind::ridge || k == CurveKind::valley; }
bool is_fixed(CurveKind k) { return k == CurveKind::sharp || k == CurveKind::border || k == CurveKind::given; }

void set_reach(const Work& work, const MeshView& original, const RefinedMesh& refined, const LayoutGraph& graph,
               std::span<const Index> label, const SmoothOptions& options, const std::vector<Index>& offset,
               Points& p) {
  const MeshView mesh = refined.mesh.view();
  const std::vector<Real> width = patch_widths(work, refined, label, graph);
  const Real total = sum(work, Cost::light, original.edge_count(), Real{0}, [&](std::size_t e) {
    return (original.point(original.edge_v0[e]) - original.point(original.edge_v1[e])).norm();
  });
  const Real mean = original.edge_count() ? total / original.edge_count() : 0;
  const auto edge_kind = [&](Index e) {
    return mesh.is_boundary_edge(e) ? CurveKind::border
           : refined.on_network[e]  ? refined.edge_kind[e]
                                    : CurveKind::subdivision;
  };
  std::vector<Real> arc_limit(graph.arc_count());
  for_each(work, Cost::heavy, graph.arc_count(), [&](std::size_t arc) {
    const Index a = static_cast<Index>(arc);
    const auto vertices = graph.arc.row(a), edges = graph.arc_edges.row(a);
    const Index first = p.nodes + offset[a], n = offset[a + 1] - offset[a];
    std::vector<Real> h(n), smoothed(n);
    for (Index i = 0; i < n; ++i) h[i] = std::min(2 * mean, mean_edge_at(original, refined.origin[vertices[i + 1]]));
    for (int round = 0; round < 3; ++round) {
      for (Index i = 0; i < n; ++i) smoothed[i] = (h[i ? i - 1 : 0] + h[i] + h[std::min(i + 1, n - 1)]) / 3;
      h.swap(smoothed);
    }
    Real limit = std::numeric_limits<Real>::infinity();
    for (Index patch : {graph.left[a], graph.right[a]})
      if (patch != kNone) limit = std::min(limit, options.width_reach * width[patch]);
    arc_limit[a] = limit;
    const Real share = is_feature(graph.kind[a]) ? options.feature_reach : options.free_reach;
    for (Index i = 0; i < n; ++i) {
      const CurveKind k = edge_kind(edges[i]), l = edge_kind(edges[i + 1]);
      const Real local = is_feature(k) || is_feature(l) ? std::min(share, options.feature_reach) : share;
      const bool crease = turns(mesh, edges[i]) && turns(mesh, edges[i + 1]);
      const bool fixed = is_fixed(k) || is_fixed(l) || crease || limit < kLeastRoom * h[i];
      p.reach[first + i] = fixed ? 0 : std::min(local * h[i], limit);
    }
  });
  std::vector<Real> node_limit(p.nodes, std::numeric_limits<Real>::infinity());
  std::vector<std::uint8_t> held(p.nodes, 0);
  for (Index a = 0; a < graph.arc_count(); ++a) {
    bool free = !is_fixed(graph.kind[a]) && (!is_feature(graph.kind[a]) || graph.artificial[graph.start[a]]);
    const auto edges = graph.arc_edges.row(a);
    for (Index e : {edges.front(), edges.back()}) free = free && !is_fixed(edge_kind(e)) && !turns(mesh, e);
    for (Index node : {graph.start[a], graph.end[a]}) {
      node_limit[node] = std::min(node_limit[node], arc_limit[a]);
      if (!free) held[node] = 1;
      // The artificial node of a closed ridge is an ordinary point of it.
      if (is_feature(graph.kind[a])) node_limit[node] = std::min(node_limit[node], options.feature_reach * mean);
    }
  }
  for_each(work, Cost::light, p.nodes, [&](std::size_t i) {
    const Real h = std::min(2 * mean, mean_edge_at(original, refined.origin[graph.node[i]]));
    p.reach[i] = held[i] || node_limit[i] < kLeastRoom * h ? 0 : std::min(options.free_reach * h, node_limit[i]);
  });
}

std::vector<Direction> choose_directions(const Work& work, const MeshView& mesh, const PrincipalLines& lines,
                                         const LayoutGraph& graph, const SmoothOptions& options,
                                         const std::vector<Index>& offset, const Points& p) {
  std::vector<Direction> choice(graph.arc_count(), Direction::t_min);
  if (!options.nearest_direction) return choice;
  for_each(work, Cost::heavy, graph.arc_count(), [&](std::size_t a) {
    Real along_min = 0, along_max = 0;
    for (Index i = p.nodes + offset[a]; i < p.nodes + offset[a + 1]; ++i) {
      const Vec3 d = p.position[p.after[i]] - p.position[p.before[i]];
      const Real length = d.norm();
      if (!(length > 0)) continue;
      const Real s = d.dot(across(mesh, lines, p.at[i], Direction::t_min));
      const Real t = d.dot(across(mesh, lines, p.at[i], Direction::t_max));
      along_min += s * s / length, along_max += t * t / length;
    }
    if (along_max < along_min) choice[a] = Direction::t_max;
  });
  return choice;
}

// One Jacobi step of every point towards the minimum of its quadratic form; returns the longest move in units of reach.
Real step(const Work& work, const MeshView& mesh, const PrincipalLines& lines, const SmoothOptions& options,
          const std::vector<Direction>& choice, Points& p, Points& next) {
  const std::size_t n = p.at.size();
  const Real alignment = 1 / std::max(options.length_weight, Real{1e-3});  // lambda 0 alone has no minimum
  std::vector<Vec3> j(n, Vec3::Zero());
  for_each(work, Cost::medium, n, [&](std::size_t i) {
    if (p.arc[i] != kNone) j[i] = across(mesh, lines, p.at[i], choice[p.arc[i]]);
  });
  return reduce(
      work, Cost::heavy, n, Real{0},
      [&](std::size_t begin, std::size_t end) {
        Real longest = 0;
        for (std::size_t i = begin; i < end; ++i) {
          next.at[i] = p.at[i], next.position[i] = p.position[i];
          if (!(p.reach[i] > 0)) continue;
          Mat3 sum = Mat3::Zero();
          Vec3 right = Vec3::Zero();
          const auto pull = [&](Index other) {
            const bool own = p.arc[i] != kNone, its = p.arc[other] != kNone;
            const Real share = alignment / (own && its ? 2 : 1);
            const Mat3 m = Mat3::Identity() + share * (j[i] * j[i].transpose() + j[other] * j[other].transpose());
            sum += m;
            right += m * p.position[other];
          };
          if (p.arc[i] == kNone)
            for (Index other : p.spokes.row(static_cast<Index>(i))) pull(other);
          else
            pull(p.before[i]), pull(p.after[i]);
          Vec3 target = p.position[i] + options.damping * (sum.llt().solve(right) - p.position[i]);
          const Vec3 away = target - p.start[i];
          const Real distance = away.norm();
          if (distance > p.reach[i]) target = p.start[i] + away * (p.reach[i] / distance);
          const FacePoint moved = walk_towards(mesh, p.at[i], target);
          const Vec3 where = position(mesh, moved);
          // The foot on the surface may lie farther out than the target: stay, so that the reach is kept exactly.
          if (!((where - p.start[i]).norm() <= p.reach[i])) continue;
          longest = std::max(longest, (where - p.position[i]).norm() / p.reach[i]);
          next.at[i] = moved, next.position[i] = where;
        }
        return longest;
      },
      [](Real a, Real b) { return std::max(a, b); });
}

SurfacePoint inside_face(const FacePoint& p) {
  std::array<Real, 3> w = p.weight;
  Real sum = 0;
  for (Real& x : w) sum += x = std::max(x, kInside);
  return SurfacePoint::in_face(p.face, w[0] / sum, w[1] / sum);
}

}  // namespace

SmoothedArcs smooth_boundaries(const Work& work, MeshView original, const RefinedMesh& refined,
                               const LayoutGraph& graph, std::span<const Index> label, const PrincipalLines& lines,
                               const SmoothOptions& options) {
  if (lines.vertex_count() != 0 && lines.vertex_count() != original.vertex_count())
    throw Error(ErrorCode::internal, "smooth_boundaries needs lines per original vertex");
  SmoothedArcs out;
  out.offset.push_back(0);
  for (Index a = 0; a < graph.arc_count(); ++a)
    out.offset.push_back(out.offset.back() + static_cast<Index>(graph.arc.row(a).size()) - 2);
  Points p = collect_points(work, original, refined, graph, out.offset);
  set_reach(work, original, refined, graph, label, options, out.offset, p);
  const std::vector<FacePoint> first = p.at;
  const std::vector<Direction> choice = choose_directions(work, original, lines, graph, options, out.offset, p);
  Points next = p;
  for (int i = 0; i < options.iterations; ++i) {
    const Real longest = step(work, original, lines, options, choice, p, next);
    p.at.swap(next.at), p.position.swap(next.position);
    if (longest < 1e-3) break;
  }

  // Length alone would shrink a small loop to a point.
  for_each(work, Cost::heavy, graph.arc_count(), [&](std::size_t a) {
    if (!graph.is_closed(static_cast<Index>(a))) return;
    const Index begin = p.nodes + out.offset[a], end = p.nodes + out.offset[a + 1];
    Real before = 0, after = 0;
    for (Index i = begin; i < end; ++i) {
      before += (p.start[i] - p.start[p.before[i]]).norm();
      after += (p.position[i] - p.position[p.before[i]]).norm();
    }
    if (after >= before / 2) return;
    for (Index i = begin; i < end; ++i) p.at[i] = first[i];
    if (graph.artificial[graph.start[a]]) p.at[graph.start[a]] = first[graph.start[a]];
  });

  out.node.resize(p.nodes), out.node_fixed.resize(p.nodes);
  out.point.resize(out.offset.back()), out.fixed.resize(out.offset.back());
  for_each(work, Cost::light, p.nodes, [&](std::size_t i) {
    out.node_fixed[i] = !(p.reach[i] > 0);
    out.node[i] = out.node_fixed[i] ? refined.origin[graph.node[i]] : inside_face(p.at[i]);
  });
  for_each(work, Cost::heavy, graph.arc_count(), [&](std::size_t a) {
    const auto vertices = graph.arc.row(static_cast<Index>(a));
    for (Index i = out.offset[a]; i < out.offset[a + 1]; ++i) {
      out.fixed[i] = !(p.reach[p.nodes + i] > 0);
      out.point[i] = out.fixed[i] ? refined.origin[vertices[i - out.offset[a] + 1]] : inside_face(p.at[p.nodes + i]);
    }
  });
  return out;
}

}  // namespace intarsia::kernels
