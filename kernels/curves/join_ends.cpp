#include "kernels/curves/join_ends.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/parallel/compact.h"
#include "engine/parallel/sort.h"
#include "engine/space/point_tree.h"
#include "kernels/curves/gap_path.h"
#include "kernels/curves/tidy_curves.h"

namespace intarsia::kernels {

namespace {

Real angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

EndFrame frame_at(const MeshView& mesh, const FeatureCurves& curves, Index end, Real reach) {
  const auto row = curves.points_of(chain_of_end(end));
  const auto at = [&](std::size_t i) { return row[end % 2 ? row.size() - 1 - i : i]; };
  const Vec3 p = position(mesh, curves.net.point[at(0)]);
  Vec3 inner = p, last = p;
  Real way = 0;
  for (std::size_t i = 1; i < row.size() && way < reach; ++i) {
    inner = position(mesh, curves.net.point[at(i)]);
    way += (inner - last).norm();
    last = inner;
  }
  const Vec3 out = p - inner;
  const Real length = out.norm();
  return {p, length > 0 ? Vec3(out / length) : Vec3(Vec3::Zero()), curves.normal[at(0)]};
}

struct Candidate {
  Real angle;
  Index a, b;  // ends, a < b
  auto key() const { return std::tie(angle, a, b); }
  bool operator<(const Candidate& other) const { return key() < other.key(); }
};

void mark_used(const SurfacePoint& p, std::vector<std::uint8_t>& vertex, std::vector<std::uint8_t>& edge) {
  if (p.kind == PointKind::vertex) vertex[p.element] = 1;
  if (p.kind == PointKind::edge) edge[p.element] = 1;
}

Index point_at(const FeatureCurves& curves, Index end) {
  const auto row = curves.points_of(chain_of_end(end));
  return end % 2 ? row.back() : row.front();
}

// Appends points at `vertices`, their values running from point p to point q. Returns p, the new points, q.
std::vector<Index> fill_gap(const MeshView& mesh, Index p, Index q, std::span<const Index> vertices,
                            FeatureCurves& curves) {
  std::vector<Index> chain{p};
  const Index base = curves.point_count();
  curves.resize_points(base + vertices.size());
  std::vector<Real> way(1, 0);
  Vec3 last = position(mesh, curves.net.point[p]);
  for (Index v : vertices) way.push_back(way.back() + (mesh.point(v) - last).norm()), last = mesh.point(v);
  const Real total = way.back() + (position(mesh, curves.net.point[q]) - last).norm();
  const Vec3 across_p = curves.across[p];
  const Vec3 across_q = across_p.dot(curves.across[q]) < 0 ? Vec3(-curves.across[q]) : curves.across[q];
  for (Index i = 0; i < vertices.size(); ++i) {
    const Index to = base + i;
    const Real w = total > 0 ? way[i + 1] / total : 0;
    curves.net.point[to] = SurfacePoint::at_vertex(vertices[i]);
    const Vec3 n = (1 - w) * curves.normal[p] + w * curves.normal[q], t = (1 - w) * across_p + w * across_q;
    curves.normal.set(to, n.norm() > 1e-9 ? Vec3(n.normalized()) : curves.normal[p]);
    curves.across.set(to, t.norm() > 1e-9 ? Vec3(t.normalized()) : across_p);
    for (auto* x : {&curves.kd, &curves.kmax, &curves.kmin, &curves.extremality, &curves.sharpness, &curves.radius,
                    &curves.turn()})
      (*x)[to] = (1 - w) * (*x)[p] + w * (*x)[q];
    chain.push_back(to);
  }
  chain.push_back(q);
  return chain;
}

}  // namespace

Real join_angle(const EndFrame& a, const EndFrame& b, const JoinOptions& options) {
  if (!(a.normal.dot(b.normal) > 0)) return -1;
  if (a.outward.isZero(0) || b.outward.isZero(0)) return -1;
  // Slack for rounding: an angle of exactly the limit is allowed.
  const Real slack = 1e-9;
  const Real gamma = angle(a.outward, -b.outward);
  if (gamma > options.gamma + slack) return -1;
  const Vec3 gap = b.point - a.point;
  if (gap.norm() < 1e-9) return gamma;
  const Real alpha = angle(a.outward, gap), beta = angle(b.outward, -gap);
  if (std::max(alpha, beta) > options.alpha + slack) return -1;
  return alpha + beta + gamma;
}

void join_ends(const Work& work, const MeshView& mesh, Real edge_length, const JoinOptions& options,
               FeatureCurves& curves) {
  const Real radius = options.radius * edge_length;
  std::vector<std::uint8_t> used_vertex(mesh.vertex_count(), 0), used_edge(mesh.edge_count(), 0);
  for (Index p : curves.net.curve.item) mark_used(curves.net.point[p], used_vertex, used_edge);

  for (int pass = 0; pass < options.passes; ++pass) {
    work.check();
    const auto uses = point_uses(curves);
    const auto loose = compact(work, 2 * std::size_t{curves.curve_count()},
                               [&](std::size_t end) { return uses[point_at(curves, static_cast<Index>(end))] == 1; });
    std::vector<EndFrame> frame(loose.size());
    Vec3Array where(loose.size());
    for_each(work, Cost::medium, loose.size(), [&](std::size_t i) {
      frame[i] = frame_at(mesh, curves, loose[i], options.direction_length * edge_length);
      where.set(i, frame[i].point);
    });
    const PointTree tree(where);
    std::vector<std::vector<Candidate>> found(block_count(Cost::medium, loose.size()));
    for_each_block(work, Cost::medium, loose.size(), [&](std::size_t begin, std::size_t end, std::size_t block) {
      std::vector<Index> near;
      for (std::size_t i = begin; i < end; ++i) {
        const Index c = chain_of_end(loose[i]);
        tree.in_radius(frame[i].point, radius, near);
        for (Index j : near) {
          if (j <= i) continue;
          const Index d = chain_of_end(loose[j]);
          if (curves.concave[c] != curves.concave[d]) continue;
          if (c == d && curves.points_of(c).size() < options.min_points_to_close) continue;
          const Real total = join_angle(frame[i], frame[j], options);
          if (total >= 0) found[block].push_back({total, loose[i], loose[j]});
        }
      }
    });
    std::vector<Candidate> candidates;
    for (const auto& block : found) candidates.insert(candidates.end(), block.begin(), block.end());
    sort_total(work, candidates.begin(), candidates.end());

    std::vector<Index> mate(2 * std::size_t{curves.curve_count()}, kNone), path;
    std::vector<std::uint8_t> taken(mate.size(), 0);
    std::size_t looked = 0, joined = 0;
    for (const Candidate& pair : candidates) {
      if (++looked % 1024 == 0) work.check();
      if (taken[pair.a] || taken[pair.b]) continue;
      const Index p = point_at(curves, pair.a), q = point_at(curves, pair.b);
      const Real gap = (position(mesh, curves.net.point[q]) - position(mesh, curves.net.point[p])).norm();
      if (!gap_path(mesh, used_vertex, used_edge, curves.net.point[p], curves.net.point[q],
                    options.detour * std::max(gap, edge_length), path))
        continue;
      taken[pair.a] = taken[pair.b] = 1;
      ++joined;
      for (Index v : path) used_vertex[v] = 1;
      const auto bridge = fill_gap(mesh, p, q, path, curves);
      const CurveKind ka = curves.net.kind[chain_of_end(pair.a)], kb = curves.net.kind[chain_of_end(pair.b)];
      // Only a mesh edge may call itself sharp; a bridge to a sharp curve belongs to the smooth side.
      const bool both = ka == kb;
      curves.add_curve(bridge, both ? ka : std::min(ka, kb), curves.concave[chain_of_end(pair.a)] != 0);
      const Index front = 2 * (curves.curve_count() - 1);
      mate.resize(std::size_t{front} + 2, kNone);
      taken.resize(mate.size(), 1);
      const auto link = [&](Index end, Index bridge_end) { mate[end] = bridge_end, mate[bridge_end] = end; };
      if (both || ka != CurveKind::sharp) link(pair.a, front);
      if (both || kb != CurveKind::sharp) link(pair.b, front + 1);
    }
    if (joined == 0) break;
    replace_chains(curves, weld_chains(curves.net.curve, mate));
  }
}

}  // namespace intarsia::kernels
