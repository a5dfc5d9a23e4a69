#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/parallel/for_each.h"
#include "graph/stages.h"
#include "kernels/network/embed_curves.h"
#include "kernels/network/extend_curves.h"
#include "kernels/network/prune_ends.h"
#include "kernels/patches/merge_patches.h"

namespace intarsia::graph {
namespace {

using namespace kernels;

constexpr Real kAlways = 1e30, kNever = -1e30;

void append(const CurveNetwork& from, CurveNetwork& to) {
  const Index first = static_cast<Index>(to.point.size());
  to.point.insert(to.point.end(), from.point.begin(), from.point.end());
  to.strength.insert(to.strength.end(), from.strength.begin(), from.strength.end());
  std::vector<Index> row;
  for (Index c = 0; c < from.curve_count(); ++c) {
    row.clear();
    for (const Index p : from.curve.row(c)) row.push_back(first + p);
    to.add_curve(row, from.kind[c]);
  }
}

// The curves a threshold may choose from, embedded once; what a threshold makes of them is then cheap to try.
class Choice {
 public:
  Choice(const Work& work, const Surface& surface, const Directions& directions, FeatureCurves candidates,
         const Guides& guides, const LayoutOptions& options)
      : work_(work),
        surface_(surface),
        directions_(directions),
        options_(options),
        candidates_(std::move(candidates)),
        guides_(guides) {
    CurveNetwork net = candidates_.net;
    std::vector<std::uint8_t> on_sharp(surface.mesh.vertex_count(), 0);
    for (Index c = 0; c < net.curve_count(); ++c)
      if (net.kind[c] == CurveKind::sharp)
        for (Index p : net.curve.row(c)) on_sharp[net.point[p].element] = 1;
    snap_curves(work, surface.mesh, on_sharp, options.snap, net);
    append(guides.curves, net);
    embedding_ = embed_curves(work, surface.mesh, net);
    patches_ = make_patch_surface(work, embedding_.refined, surface.face_normal, surface.detail,
                                  options.subdivide.hole_length);
    for (std::size_t i = 0; i < embedding_.edge.size(); ++i) {  // ascending, one entry for each curve on an edge
      const Real level = is_pinned(embedding_.edge[i]) ? kNever : level_of(embedding_.edge_curve[i]);
      if (edge_.empty() || edge_.back() != embedding_.edge[i])
        edge_.push_back(embedding_.edge[i]), level_.push_back(level);
      else
        level_.back() = std::max(level_.back(), level);
    }
  }

  struct Result {
    std::vector<std::uint8_t> active;
    ExtensionResult extension;
    Index patches = 0;
  };

  Result extend(Real threshold) const {
    const RefinedMesh& refined = embedding_.refined;
    const Terrain terrain(refined, directions_.normal, directions_.field, surface_.mesh.vertex_count(),
                          surface_.detail);
    Result r;
    r.active.resize(refined.mesh.edge_count());
    for_each(work_, Cost::light, r.active.size(),
             [&](std::size_t e) { r.active[e] = refined.mesh.edge_f1[e] == kNone ? 1 : 0; });
    for (std::size_t i = 0; i < edge_.size(); ++i)
      if (level_[i] >= threshold) r.active[edge_[i]] = 1;
    r.extension = extend_curves(work_, refined, r.active, terrain, options_.extension);
    for (Index e : r.extension.edge) r.active[e] = 1;
    prune_ends(work_, refined.mesh, r.active);
    r.patches = count_after_merge(work_, patches_, r.active, options_.subdivide.merge);
    return r;
  }

  // The lowest threshold, at least `from`, whose network adds at most `most` patches to the pieces that the surface has
  // anyway, by bisection on logarithms.
  Real threshold_for(Index most, Real from) {
    Result first = extend(from);
    if (first.patches <= most) {
      keep(from, std::move(first));
      return from;
    }
    const Index pieces = extend(2 * kAlways).patches;
    most = most == kNone ? kNone : most + pieces - 1;
    Real low = from, high = from;
    for (Real s : candidates_.component_saliency) high = std::max(high, 1.01 * s);
    for (int step = 0; step < options_.choice.steps && !work_.is_late(); ++step) {
      const Real middle = std::sqrt(low * high);
      Result r = extend(middle);
      (r.patches <= most ? high : low) = middle;
      if (r.patches <= most) keep(middle, std::move(r));
    }
    return high;
  }

  Network finish(Real threshold) {
    Result r = kept_threshold_ == threshold ? std::move(kept_) : extend(threshold);
    Network n;
    n.min_saliency = threshold;
    n.patches = r.patches;
    n.ends = r.extension.ends, n.met = r.extension.met;
    n.bridged = r.extension.bridged, n.dead = r.extension.dead;
    for (Index c = 0; c < candidates_.curve_count(); ++c) {
      if (level_of(c) < threshold) continue;
      const auto row = candidates_.points_of(c);
      n.features.add_curve({row.begin(), row.end()}, candidates_.net.kind[c]);
      n.feature_concave.push_back(candidates_.concave[c]);
    }
    n.features.point = candidates_.net.point;
    n.features.strength = candidates_.net.strength;
    append(guides_.curves, n.features);
    n.feature_concave.resize(n.features.curve_count(), 0);
    for (std::size_t i = 0; i < edge_.size(); ++i)
      if (level_[i] >= threshold) n.feature_edge.push_back(edge_[i]);
    n.refined = std::move(embedding_.refined);
    for (Index e : r.extension.edge)
      if (!n.refined.on_network[e] || !std::binary_search(n.feature_edge.begin(), n.feature_edge.end(), e))
        n.refined.edge_kind[e] = CurveKind::extension, n.refined.edge_strength.set(e, 0);
    n.refined.on_network = std::move(r.active);
    if (!guides_.pin.empty()) {
      n.locked.resize(n.refined.mesh.face_count());
      for_each(work_, Cost::light, n.locked.size(),
               [&](std::size_t f) { n.locked[f] = guides_.pin[n.refined.parent[f]] == kNone ? 0 : 1; });
    }
    return n;
  }

 private:
  // Inside a pinned region, where nothing may run.
  bool is_pinned(Index edge) const {
    const MeshView mesh = embedding_.refined.mesh;
    if (guides_.pin.empty() || mesh.is_boundary_edge(edge)) return false;
    const auto pin = [&](Index f) { return guides_.pin[embedding_.refined.parent[f]]; };
    return pin(mesh.edge_f0[edge]) != kNone && pin(mesh.edge_f0[edge]) == pin(mesh.edge_f1[edge]);
  }
  // Sharp curves pass every threshold.
  Real level_of(Index curve) const {
    if (curve >= candidates_.curve_count()) return kAlways;  // given
    const Index component = candidates_.component[curve];
    const auto passed = candidates_.component_passed[component];
    if (candidates_.net.kind[curve] == CurveKind::sharp || passed == 2) return kAlways;
    return passed == 0 ? -1 : candidates_.component_saliency[component];
  }

  // What finish() will most likely ask for.
  void keep(Real threshold, Result&& result) { kept_threshold_ = threshold, kept_ = std::move(result); }

  const Work& work_;
  const Surface& surface_;
  const Directions& directions_;
  const LayoutOptions& options_;
  FeatureCurves candidates_;
  const Guides& guides_;
  Real kept_threshold_ = std::numeric_limits<Real>::quiet_NaN();
  Result kept_;
  Embedding embedding_;
  PatchSurface patches_;
  std::vector<Index> edge_;  // refined edges that carry curves, ascending
  std::vector<Real> level_;  // and the saliency of the component, the largest of them
};

}  // namespace

Directions curvature_to_directions(const Work& work, const Surface& surface, const Curvature& curvature,
                                   const LayoutOptions& options) {
  return {direction_field(work, surface.mesh, curvature.fields, options.direction), curvature.fields.normal};
}

Network curves_to_network(const Work& work, const Surface& surface, const Directions& directions, const Curves& curves,
                          const Guides& guides, const LayoutOptions& options) {
  const ChoiceOptions& c = options.choice;
  if (options.mode == Mode::paper) {
    Choice all(work, surface, directions, curves.curves, guides, options);
    return all.finish(-0.5);
  }
  const Real lowest = options.patches > 0 ? c.weakest : c.min_saliency;
  Choice choice(work, surface, directions, filter_by_saliency(work, curves.curves, lowest), guides, options);
  const Real budget = options.form == SubdivideForm::quality ? c.quality_budget : c.budget;
  const Index most = options.patches > 0 ? std::max<Index>(1, static_cast<Index>(std::floor(budget * options.patches)))
                                         : c.most_patches;
  return choice.finish(choice.threshold_for(most, lowest));
}

}  // namespace intarsia::graph
