#include <algorithm>
#include <numeric>

#include "engine/parallel/compact.h"
#include "engine/parallel/sort.h"
#include "graph/stages.h"
#include "kernels/cells/grouping.h"
#include "kernels/layout/match_labels.h"
#include "kernels/layout/patch_of_faces.h"
#include "kernels/layout/trace_boundaries.h"
#include "kernels/network/embed_curves.h"
#include "kernels/patches/flood_patches.h"
#include "kernels/patches/measure_patches.h"
#include "kernels/ridges/chain_segments.h"

namespace intarsia::graph {
namespace {

using namespace kernels;

// The borders of the patches embedded in the surface anew, with the patch ids they had.
struct Embedded {
  RefinedMesh refined;
  PatchLabels labels;
  Index kept_chains = 0;
};

// Smoothed arcs that would break the layout go back to the chains they were traced from; if that does not help, all do.
Embedded embed_smoothed(const Work& work, const Surface& surface, const Smoothing& old, const SmoothedArcs& arcs,
                        const CrossOptions& options) {
  const LayoutGraph& graph = old.graph;
  std::vector<std::uint8_t> keep(graph.arc_count(), 0);
  constexpr int kAttempts = 4;
  for (int attempt = 0;; ++attempt) {
    if (attempt == kAttempts) std::fill(keep.begin(), keep.end(), 1);
    const CrossedArcs crossed = cross_edges(work, surface.mesh, old.refined, graph, arcs, keep, options);
    Embedding e = embed_curves(work, surface.mesh, crossed.network);
    PatchLabels fresh = flood_patches(work, e.refined.mesh, e.refined.on_network);
    const LabelMatch match =
        match_labels(work, surface.mesh, old.shares, graph.patch_count(), e.refined, fresh.patch_of_face, fresh.count);
    std::vector<Index> trouble = match.trouble;
    if (match.ok) {
      for_each(work, Cost::light, fresh.patch_of_face.size(),
               [&](std::size_t f) { fresh.patch_of_face[f] = match.old_of_new[fresh.patch_of_face[f]]; });
      trouble = patches_out_of_place(work, graph, e.refined.mesh, fresh.patch_of_face, e.edge, e.edge_curve);
    }
    if ((!match.ok || !trouble.empty()) && attempt < kAttempts) {
      const std::vector<std::uint8_t> more = arcs_of_patches(graph, trouble);
      for (std::size_t a = 0; a < keep.size(); ++a) keep[a] |= more[a];
      continue;
    }
    Embedded out;
    out.refined = std::move(e.refined);
    out.labels = std::move(fresh);
    out.kept_chains = static_cast<Index>(std::count(crossed.as_traced.begin(), crossed.as_traced.end(), 1));
    return out;
  }
}

// Reconstruction error of every patch.
std::vector<Real> patch_errors(const Work& work, const Surface& surface, const RefinedMesh& refined,
                               const PatchLabels& labels, const LayoutGraph& graph, Real hole_length) {
  const PatchSurface measured = make_patch_surface(work, refined, surface.face_normal, surface.detail, hole_length);
  const PatchTable table = measure_patches(work, measured, labels);
  CellOptions options;
  options.smoothing = 0;
  const CellComplex complex = make_cell_complex(work, refined, labels, table, graph, hole_length, options);
  std::vector<Index> own(labels.count);
  std::iota(own.begin(), own.end(), Index{0});
  GroupOptions group;
  group.outline.loop_points = 85;
  const Grouping grouping(work, complex, std::move(own), labels.count, group);
  std::vector<Real> error(labels.count);
  for (Index p = 0; p < labels.count; ++p) error[p] = grouping.shape(p).error;
  return error;
}

// Patches that smoothing their borders made much worse: twice as bad, and of weight in the whole.
std::vector<Index> spoilt_patches(const std::vector<Real>& before, const std::vector<Real>& after) {
  constexpr Real kWorse = 2, kWeight = 1, kNothing = 1e-12;  // diagonals^4: what rounding makes
  Real total = 0;
  for (const Real e : before) total += e;
  const Real mean = total / static_cast<Real>(std::max<std::size_t>(1, before.size()));
  std::vector<Index> spoilt;
  for (Index p = 0; p < before.size(); ++p)
    if (after[p] > kWorse * before[p] && after[p] - before[p] > kWeight * mean + kNothing) spoilt.push_back(p);
  return spoilt;
}

// The zigzag of mesh edges is less than half an edge wide: that much may go where more would spoil a patch.
SmoothOptions gentler(SmoothOptions o) {
  o.free_reach = std::min(o.free_reach, Real{0.5});
  return o;
}

// The chosen arcs, with the nodes at their ends, at the gentler places.
SmoothedArcs with_gentle(const LayoutGraph& graph, SmoothedArcs arcs, const SmoothedArcs& gentle,
                         std::span<const std::uint8_t> chosen) {
  for (Index a = 0; a < graph.arc_count(); ++a) {
    if (!chosen[a]) continue;
    for (const Index node : {graph.start[a], graph.end[a]}) arcs.node[node] = gentle.node[node];
    for (Index i = arcs.offset[a]; i < arcs.offset[a + 1]; ++i) arcs.point[i] = gentle.point[i];
  }
  return arcs;
}

// Chosen features that ended up inside patches, as chains of the refined edges they became.
CurveNetwork interior_curves(const Work& work, const Network& network, const PatchLabels& labels) {
  const MeshView mesh = network.refined.mesh;
  std::vector<Index> a, b;
  for (Index e : network.feature_edge) {
    if (mesh.is_boundary_edge(e)) continue;
    if (labels.patch_of_face[mesh.edge_f0[e]] != labels.patch_of_face[mesh.edge_f1[e]]) continue;
    a.push_back(mesh.edge_v0[e]), b.push_back(mesh.edge_v1[e]);
  }
  CurveNetwork interior;
  const Csr chains = chain_segments(work, mesh.vertex_count(), a, b, {});
  std::vector<Index> row;
  for (Index c = 0; c < chains.rows(); ++c) {
    row.clear();
    for (Index v : chains.row(c)) {
      row.push_back(static_cast<Index>(interior.point.size()));
      interior.point.push_back(network.refined.origin[v]);
    }
    const Index e = mesh.edge_between(chains.row(c)[0], chains.row(c)[1]);
    interior.add_curve(row, network.refined.edge_kind[e]);
  }
  return interior;
}

// What pictures and reports show of the network: its curves' edges alone carry the mesh.
Network outline_of(const Work& work, const Network& network) {
  Network out;
  out.features = network.features, out.feature_concave = network.feature_concave;
  out.min_saliency = network.min_saliency, out.patches = network.patches;
  out.ends = network.ends, out.met = network.met, out.bridged = network.bridged, out.dead = network.dead;
  const RefinedMesh& from = network.refined;
  const MeshView mesh = from.mesh;
  const std::vector<Index> edge = compact(work, mesh.edge_count(), [&](std::size_t e) { return from.on_network[e]; });
  std::vector<Index> vertex;
  for (const Index e : edge) vertex.push_back(mesh.edge_v0[e]), vertex.push_back(mesh.edge_v1[e]);
  sort_total(work, vertex.begin(), vertex.end());
  vertex.erase(std::unique(vertex.begin(), vertex.end()), vertex.end());
  Mesh& to = out.refined.mesh;
  for (const Index v : vertex) to.x.push_back(mesh.x[v]), to.y.push_back(mesh.y[v]), to.z.push_back(mesh.z[v]);
  const auto place = [&](Index v) {
    return static_cast<Index>(std::lower_bound(vertex.begin(), vertex.end(), v) - vertex.begin());
  };
  for (const Index e : edge) {
    to.edge_v0.push_back(place(mesh.edge_v0[e])), to.edge_v1.push_back(place(mesh.edge_v1[e]));
    out.refined.on_network.push_back(1), out.refined.edge_kind.push_back(from.edge_kind[e]);
  }
  return out;
}

}  // namespace

Lines curvature_to_lines(const Work& work, const Curvature& curvature) {
  return {principal_lines(work, curvature.fields)};
}

Smoothing patches_to_smoothing(const Work& work, const Surface& surface, const Lines& lines, const Network& network,
                               const Patches& patches, const LayoutOptions& options) {
  const RefinedMesh& refined = network.refined;
  const PatchLabels& labels = patches.labels;
  Smoothing s;
  s.graph = trace_boundaries(work, refined, labels.patch_of_face, labels.count);
  s.arcs = smooth_boundaries(work, surface.mesh, refined, s.graph, labels.patch_of_face, lines.lines, options.smooth);
  s.shares = label_shares(work, surface.mesh, refined, labels.patch_of_face);
  if (options.guard_smoothing && !work.is_late()) {
    s.gentle = smooth_boundaries(work, surface.mesh, refined, s.graph, labels.patch_of_face, lines.lines,
                                 gentler(options.smooth));
    s.error = patch_errors(work, surface, refined, labels, s.graph, options.check.hole_length);
  }
  s.interior = interior_curves(work, network, labels);
  s.refined.origin = refined.origin;
  s.refined.on_network = refined.on_network, s.refined.edge_strength = refined.edge_strength;
  s.network = outline_of(work, network);
  return s;
}

Layout smoothing_to_layout(const Work& work, const Surface& surface, const Smoothing& smoothing,
                           const LayoutOptions& options) {
  const Index arc_count = smoothing.graph.arc_count();
  std::vector<std::uint8_t> gentle(arc_count, 0);
  SmoothedArcs arcs = smoothing.arcs;
  Layout layout;
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    layout = {};
    Embedded e = embed_smoothed(work, surface, smoothing, arcs, options.cross);
    layout.refined = std::move(e.refined);
    layout.labels = std::move(e.labels);
    layout.kept_chains = e.kept_chains;
    layout.graph = trace_boundaries(work, layout.refined, layout.labels.patch_of_face, layout.labels.count);
    if (smoothing.error.empty() || round + 1 == kRounds || work.is_late()) break;
    const std::vector<Index> spoilt = spoilt_patches(
        smoothing.error,
        patch_errors(work, surface, layout.refined, layout.labels, layout.graph, options.check.hole_length));
    const std::vector<std::uint8_t> more = arcs_of_patches(smoothing.graph, spoilt);
    bool any = false;
    for (Index a = 0; a < arc_count; ++a)
      if (more[a] && !gentle[a]) gentle[a] = 1, any = true;
    if (!any) break;
    arcs = with_gentle(smoothing.graph, smoothing.arcs, smoothing.gentle, gentle);
  }
  const PatchSurface measured =
      make_patch_surface(work, layout.refined, surface.face_normal, surface.detail, options.check.hole_length);
  layout.table = measure_patches(work, measured, layout.labels);
  layout.checks = check_layout(work, surface.mesh, layout.refined, layout.labels.patch_of_face, layout.labels.count,
                               layout.graph, options.check);
  layout.face_patch = patch_of_original_faces(work, surface.mesh, layout.refined, layout.labels.patch_of_face);
  layout.interior = smoothing.interior;
  return layout;
}

Layout patches_to_layout(const Work& work, const Surface& surface, const Curvature& curvature, const Network& network,
                         const Patches& patches, const LayoutOptions& options) {
  const Lines lines = curvature_to_lines(work, curvature);
  return smoothing_to_layout(work, surface, patches_to_smoothing(work, surface, lines, network, patches, options),
                             options);
}

}  // namespace intarsia::graph
