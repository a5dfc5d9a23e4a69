#include "kernels/ridges/trace_ridges.h"

#include <algorithm>
#include <cmath>

#include "engine/data/sample_levels.h"
#include "engine/data/weld_chains.h"
#include "engine/parallel/compact.h"
#include "engine/parallel/sort.h"
#include "kernels/ridges/chain_segments.h"
#include "kernels/ridges/curvature_falloff.h"

namespace intarsia::kernels {

namespace {

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const Real length = v.norm();
  return length > 1e-12 ? Vec3(v / length) : otherwise;
}

// -k'' / k^3 by a least-squares slope of e over the corners of the faces around the edge; e is zero at p.
Real sharpness_at(const MeshView& mesh, const CrestFields& crest, Index edge, const Vec3& p, const Vec3& t, Real k) {
  Index corner[4] = {mesh.edge_v0[edge], mesh.edge_v1[edge], kNone, kNone}, n = 2;
  for (Index f : {mesh.edge_f0[edge], mesh.edge_f1[edge]}) {
    if (f == kNone) continue;
    for (Index w : mesh.face(f))
      if (w != corner[0] && w != corner[1] && n < 4) corner[n++] = w;
  }
  Real es = 0, ss = 0;
  for (Index i = 0; i < n; ++i) {
    const Index w = corner[i];
    if (!crest.fields.direction_ok[w]) continue;
    const Real s = (mesh.point(w) - p).dot(t);
    es += (crest.t(w).dot(t) < 0 ? -crest.e(w) : crest.e(w)) * s;
    ss += s * s;
  }
  const Real cube = k * k * k;
  if (!(ss > 0) || !(cube > 0)) return 0;
  return std::clamp(-es / (ss * cube), Real(-100), Real(100));
}

void fill_crossing(const MeshView& mesh, const CrestFields& crest, Index edge, Real a, Index i,
                   CurvatureFalloff& falloff, FeatureCurves& out) {
  const CurvatureFields& f = crest.fields;
  const Index v1 = mesh.edge_v0[edge], v2 = mesh.edge_v1[edge];
  const auto mix = [&](const std::vector<Real>& x) { return (1 - a) * x[v1] + a * x[v2]; };
  out.net.point[i] = a == 0   ? SurfacePoint::at_vertex(v1)
                     : a == 1 ? SurfacePoint::at_vertex(v2)
                              : SurfacePoint::on_edge(edge, a);
  const Vec3 n1 = f.normal[v1], n2 = f.normal[v2], t1 = crest.t(v1);
  const Vec3 t2 = t1.dot(crest.t(v2)) < 0 ? Vec3(-crest.t(v2)) : crest.t(v2);
  const Vec3 n = unit_or((1 - a) * n1 + a * n2, n1);
  const Vec3 t = (1 - a) * t1 + a * t2;
  const Vec3 across = unit_or(t - t.dot(n) * n, t1);
  out.normal.set(i, n);
  out.across.set(i, across);
  out.kmax[i] = mix(f.kmax), out.kmin[i] = mix(f.kmin), out.radius[i] = mix(f.radius);
  out.kd[i] = (1 - a) * crest.k(v1) + a * crest.k(v2);
  out.extremality[i] = (1 - a) * std::hypot(f.emax[v1], f.emin[v1]) + a * std::hypot(f.emax[v2], f.emin[v2]);
  const Vec3 p = (1 - a) * mesh.point(v1) + a * mesh.point(v2);
  const bool wide = is_disc(f.ring[v1]) && is_disc(f.ring[v2]) && out.kd[i] > 0;
  out.sharpness[i] =
      wide ? 2 * falloff.at(v1, p, across, out.kd[i]) : sharpness_at(mesh, crest, edge, p, across, out.kd[i]);
}

// A centre node: means over its three crossings.
void fill_centre(const MeshView& mesh, Index face, std::span<const Index> crossing, const EdgeCrossings& crossings,
                 bool centre_of_points, Index i, FeatureCurves& out) {
  Real weight[4] = {};  // of the corners, and what corner_of() says of others
  Vec3 n = Vec3::Zero(), t = Vec3::Zero();
  const Vec3 t0 = out.across[crossing[0]];
  for (auto* field : {&out.kd, &out.kmax, &out.kmin, &out.extremality, &out.sharpness, &out.radius}) (*field)[i] = 0;
  for (Index c : crossing) {
    const Index e = crossings.edge[c];
    const Real a = centre_of_points ? crossings.position[c] : 0.5;
    weight[mesh.corner_of(face, mesh.edge_v0[e])] += (1 - a) / 3;
    weight[mesh.corner_of(face, mesh.edge_v1[e])] += a / 3;
    n += out.normal[c];
    const Vec3 tc = out.across[c];
    t += tc.dot(t0) < 0 ? Vec3(-tc) : tc;
    for (auto* field : {&out.kd, &out.kmax, &out.kmin, &out.extremality, &out.sharpness, &out.radius})
      (*field)[i] += (*field)[c] / 3;
  }
  out.net.point[i] = SurfacePoint::in_face(face, weight[0], weight[1]);
  out.normal.set(i, unit_or(n, out.normal[crossing[0]]));
  out.across.set(i, unit_or(t, t0));
}

// Of the three chains that end at each centre, the straightest two become one (others end there).
std::vector<Index> straight_pairs(const MeshView& mesh, const SegmentGraph& graph, const Csr& chains,
                                  const FeatureCurves& points, Real straight) {
  std::vector<Index> mate(2 * std::size_t{chains.rows()}, kNone);
  if (graph.centre_face.empty()) return mate;
  std::vector<Index> end_at(3 * graph.centre_face.size(), kNone);
  for (Index end = 0; end < mate.size(); ++end) {
    const auto row = chains.row(chain_of_end(end));
    const Index node = end % 2 ? row.back() : row.front();
    if (node < graph.crossing_count) continue;
    std::size_t at = 3 * std::size_t{node - graph.crossing_count};
    while (end_at[at] != kNone) ++at;
    end_at[at] = end;
  }
  const auto direction = [&](Index end) {  // from the centre into the chain
    const auto row = chains.row(chain_of_end(end));
    const std::size_t reach = std::min<std::size_t>(3, row.size() - 1);
    const Index from = end % 2 ? row.back() : row.front();
    const Index to = end % 2 ? row[row.size() - 1 - reach] : row[reach];
    return unit_or(position(mesh, points.net.point[to]) - position(mesh, points.net.point[from]), Vec3::Zero());
  };
  for (std::size_t c = 0; c < graph.centre_face.size(); ++c) {
    const Index* end = &end_at[3 * c];
    Real best = std::cos(straight);
    int pick = -1;
    for (int k = 0; k < 3; ++k) {
      if (end[k] == kNone || end[(k + 1) % 3] == kNone) continue;
      const Real cosine = -direction(end[k]).dot(direction(end[(k + 1) % 3]));
      if (cosine > best) best = cosine, pick = k;
    }
    if (pick >= 0) mate[end[pick]] = end[(pick + 1) % 3], mate[end[(pick + 1) % 3]] = end[pick];
  }
  return mate;
}

// Crossings of different edges that lie on one vertex become one point: the first of them.
std::vector<Index> merge_at_vertices(const Work& work, const FeatureCurves& points, Index nodes) {
  const auto at_vertex =
      compact(work, nodes, [&](std::size_t i) { return points.net.point[i].kind == PointKind::vertex; });
  std::vector<Index> same(nodes);
  for (Index i = 0; i < nodes; ++i) same[i] = i;
  std::vector<std::pair<Index, Index>> key(at_vertex.size());
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = {points.net.point[at_vertex[i]].element, at_vertex[i]};
  sort_total(work, key.begin(), key.end());
  for (std::size_t i = 1; i < key.size(); ++i)
    if (key[i].first == key[i - 1].first) same[key[i].second] = same[key[i - 1].second];
  return same;
}

}  // namespace

FeatureCurves trace_ridges(const Work& work, const MeshView& mesh, const CurvatureFields& fields, CurveKind channel,
                           std::span<const std::uint8_t> suppressed, const RidgeOptions& options) {
  std::vector<Real> smoothed;
  if (options.smoothing > 0) smoothed = smooth_extremality(work, mesh, fields, channel, options.smoothing);
  const CrestFields crest(fields, channel, smoothed), measured(fields, channel);
  const EdgeCrossings crossings = edge_crossings(work, mesh, crest, suppressed, options.crossing);
  const SegmentGraph graph = face_segments(work, mesh, crossings.edge);
  const Index nodes = graph.node_count();

  FeatureCurves out;
  out.resize_points(nodes);
  for_each_block(work, Cost::medium, crossings.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
    // Not the smoothed extremality: that would blunt what `sharpness` is to tell.
    CurvatureFalloff falloff(mesh, measured);
    for (std::size_t i = begin; i < end; ++i)
      fill_crossing(mesh, measured, crossings.edge[i], crossings.position[i], static_cast<Index>(i), falloff, out);
  });
  std::vector<Index> centre_crossing(3 * graph.centre_face.size(), kNone);
  for (Index s = 0; s < graph.segment_count(); ++s) {
    if (graph.b[s] < graph.crossing_count) continue;
    std::size_t at = 3 * std::size_t{graph.b[s] - graph.crossing_count};
    while (centre_crossing[at] != kNone) ++at;
    centre_crossing[at] = graph.a[s];
  }
  for (std::size_t c = 0; c < graph.centre_face.size(); ++c)
    fill_centre(mesh, graph.centre_face[c], std::span<const Index>(centre_crossing).subspan(3 * c, 3), crossings,
                options.centre_of_points, graph.crossing_count + static_cast<Index>(c), out);

  const Csr chains = chain_segments(work, nodes, graph.a, graph.b, {});
  const auto mate = straight_pairs(mesh, graph, chains, out, options.straight);
  const WeldedChains welded = weld_chains(chains, mate);
  const std::vector<Index> same = merge_at_vertices(work, out, nodes);
  std::vector<Index> row;
  out.net.curve.offset.assign(1, 0);
  for (Index c = 0; c < welded.chain.rows(); ++c) {
    row.clear();
    for (Index node : welded.chain.row(c))
      if (row.empty() || row.back() != same[node]) row.push_back(same[node]);
    if (row.size() >= 2) out.add_curve(row, channel, channel == CurveKind::valley);
  }
  return out;
}

}  // namespace intarsia::kernels
