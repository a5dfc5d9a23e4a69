#include <algorithm>
#include <cmath>

#include "graph/stages.h"
#include "kernels/network/embed_curves.h"
#include "kernels/network/extend_curves.h"
#include "kernels/network/prune_ends.h"
#include "kernels/patches/merge_patches.h"

namespace intarsia::graph {
namespace {

using namespace kernels;

constexpr Real kAlways = 1e30;

// The curves a threshold may choose from, embedded once; what a threshold makes of them is then cheap to try.
class Choice {
 public:
  Choice(const Work& work, const Surface& surface, const Curvature& curvature, FeatureCurves candidates,
         const LayoutOptions& options)
      : work_(work), surface_(surface), options_(options), candidates_(std::move(candidates)) {
    CurveNetwork net = candidates_.net;
    std::vector<std::uint8_t> on_sharp(surface.mesh.vertex_count(), 0);
    for (Index c = 0; c < net.curve_count(); ++c)
      if (net.kind[c] == CurveKind::sharp)
        for (Index p : net.curve.row(c)) on_sharp[net.point[p].element] = 1;
    snap_curves(work, surface.mesh, on_sharp, options.snap, net);
    embedding_ = embed_curves(work, surface.mesh, net);
    field_ = direction_field(work, surface.mesh, curvature.fields, options.direction);
    normal_ = curvature.fields.normal;
    level_.assign(embedding_.refined.mesh.edge_count(), -1);
    for (std::size_t i = 0; i < embedding_.edge.size(); ++i)
      level_[embedding_.edge[i]] = std::max(level_[embedding_.edge[i]], level_of(embedding_.edge_curve[i]));
  }

  struct Result {
    std::vector<std::uint8_t> active;
    ExtensionResult extension;
    Index patches = 0;
  };

  Result extend(Real threshold) const {
    const RefinedMesh& refined = embedding_.refined;
    const Terrain terrain(refined, normal_, field_, surface_.mesh.vertex_count(), surface_.mean_edge);
    Result r;
    r.active.resize(refined.mesh.edge_count());
    for (Index e = 0; e < r.active.size(); ++e)
      r.active[e] = refined.mesh.edge_f1[e] == kNone || level_[e] >= threshold ? 1 : 0;
    r.extension = extend_curves(work_, refined, r.active, terrain, options_.extension);
    for (Index e : r.extension.edge) r.active[e] = 1;
    prune_ends(work_, refined.mesh, r.active);
    const PatchSurface patches =
        make_patch_surface(work_, refined, surface_.face_normal, surface_.mean_edge, options_.subdivide.hole_length);
    r.patches = count_after_merge(work_, patches, r.active, options_.subdivide.merge);
    return r;
  }

  // The lowest threshold, at least `from`, whose network adds at most `most` patches to the pieces that the surface has
  // anyway, by bisection on logarithms.
  Real threshold_for(Index most, Real from) const {
    if (extend(from).patches <= most) return from;
    const Index pieces = extend(2 * kAlways).patches;
    most = most == kNone ? kNone : most + pieces - 1;
    Real low = from, high = from;
    for (Real s : candidates_.component_saliency) high = std::max(high, 1.01 * s);
    for (int step = 0; step < options_.choice.steps; ++step) {
      const Real middle = std::sqrt(low * high);
      (extend(middle).patches <= most ? high : low) = middle;
    }
    return high;
  }

  Network finish(Real threshold) {
    Result r = extend(threshold);
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
    for (Index e = 0; e < level_.size(); ++e)
      if (level_[e] >= threshold) n.feature_edge.push_back(e);
    n.refined = std::move(embedding_.refined);
    for (Index e : r.extension.edge)
      if (!n.refined.on_network[e] || level_[e] < threshold)
        n.refined.edge_kind[e] = CurveKind::extension, n.refined.edge_strength[e] = 0;
    n.refined.on_network = std::move(r.active);
    return n;
  }

 private:
  // Sharp curves pass every threshold.
  Real level_of(Index curve) const {
    const Index component = candidates_.component[curve];
    const auto passed = candidates_.component_passed[component];
    if (candidates_.net.kind[curve] == CurveKind::sharp || passed == 2) return kAlways;
    return passed == 0 ? -1 : candidates_.component_saliency[component];
  }

  const Work& work_;
  const Surface& surface_;
  const LayoutOptions& options_;
  FeatureCurves candidates_;
  Embedding embedding_;
  DirectionField field_;
  Vec3View normal_;
  std::vector<Real> level_;  // per refined edge: saliency of its component; -1 without a curve
};

}  // namespace

Network curves_to_network(const Work& work, const Surface& surface, const Curvature& curvature, const Curves& curves,
                          const LayoutOptions& options) {
  const ChoiceOptions& c = options.choice;
  if (options.mode == Mode::paper) {
    Choice all(work, surface, curvature, curves.curves, options);
    return all.finish(-0.5);
  }
  const Real lowest = options.patches > 0 ? c.weakest : c.min_saliency;
  Choice choice(work, surface, curvature, filter_by_saliency(work, curves.curves, lowest), options);
  const Real budget = options.form == SubdivideForm::quality ? c.quality_budget : c.budget;
  const Index most = options.patches > 0 ? std::max<Index>(1, static_cast<Index>(std::floor(budget * options.patches)))
                                         : c.most_patches;
  return choice.finish(choice.threshold_for(most, lowest));
}

}  // namespace intarsia::graph
