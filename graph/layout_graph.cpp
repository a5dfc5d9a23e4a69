#include "graph/layout_graph.h"

#include <string>

#include "engine/io/artefact_file.h"
#include "graph/visit_options.h"

namespace intarsia::graph {
namespace {

struct Seen {
  LayoutOptions options;
  std::uint64_t hash;
};

Seen seen(StageGroup group, const LayoutOptions& all) {
  const LayoutOptions options = options_up_to(group, all);
  return {options, exact_hash(options)};
}

}  // namespace

void check_options(const LayoutOptions& options) {
  visit_options(options, [](const char* name, const auto& value, const char* help, auto least, auto most) {
    const Real v = static_cast<Real>(value);
    if (!(v >= static_cast<Real>(least) && v <= static_cast<Real>(most)) && v != static_cast<Real>(kNone))
      throw Error(ErrorCode::bad_argument, std::string("option ") + name + " (" + help + ") must lie in " +
                                               std::to_string(least) + " .. " + std::to_string(most));
  });
}

FeaturePorts add_feature_stages(Flow& flow, const Port<Soup>& soup, const LayoutOptions& all_options) {
  const Seen for_features = seen(StageGroup::features, all_options);
  const LayoutOptions& options = for_features.options;
  const std::uint64_t hash = for_features.hash;
  FeaturePorts p;
  const auto surface = [options](const Work& w, const Soup& s) { return mesh_to_surface(w, s, options); };
  p.surface = add_stage(flow, Stage<Surface, Soup>{"surface", 2, hash, surface, {}, 1}, soup);
  const auto sharp = [options](const Work& w, const Surface& s) { return surface_to_sharp(w, s, options); };
  p.sharp = add_stage(flow, Stage<Sharp, Surface>{"surface", 1, hash, sharp, "sharp", 0.1}, p.surface);
  const auto scale = [options](const Work& w, const Surface& s, const Sharp& e) {
    return surface_to_scale(w, s, e, options);
  };
  p.scale = add_stage(flow, Stage<Scale, Surface, Sharp>{"scale", 1, hash, scale, {}, 4}, p.surface, p.sharp);
  const auto curvature = [options](const Work& w, const Surface& s, const Scale& k, const Sharp& e) {
    return scale_to_curvature(w, s, k, e, options);
  };
  p.curvature = add_stage(flow, Stage<Curvature, Surface, Scale, Sharp>{"curvature", 1, hash, curvature, {}, 2},
                          p.surface, p.scale, p.sharp);
  return p;
}

namespace {

// With a tolerance it sees every option, since it makes whole layouts; else only the number.
Port<Goal> add_goal_stage(Flow& flow, const LayoutOptions& options, const Port<Surface>& surface,
                          const Port<Directions>& guide, const Port<Lines>& lines, const Port<Curves>& curves,
                          const Port<Guides>& guides) {
  const bool searches = options.tolerance.value > 0;
  const auto goal = [options](const Work& w, const Surface& s, const Directions& d, const Lines& l, const Curves& c,
                              const Guides& g) { return curves_to_goal(w, s, d, l, c, g, options); };
  return add_stage(
      flow,
      Stage<Goal, Surface, Directions, Lines, Curves, Guides>{
          "network", 1, searches ? exact_hash(options) : options.patches, goal, "goal", searches ? 12.0 : 0.01},
      surface, guide, lines, curves, guides);
}

}  // namespace

LayoutPorts add_layout_stages(Flow& flow, const Port<Soup>& soup, const LayoutOptions& all_options,
                              const GuideSource& source) {
  LayoutPorts p;
  p.features = add_feature_stages(flow, soup, all_options);
  const auto& [surface, sharp, scale, curvature] = p.features;

  const Seen for_curves = seen(StageGroup::curves, all_options);
  const auto channel = [options = for_curves.options](CurveKind kind) {
    return [options, kind](const Work& w, const Surface& s, const Curvature& k, const Sharp& e) {
      return curvature_to_ridges(w, s, k, e, kind, options);
    };
  };
  using RidgeStage = Stage<Ridges, Surface, Curvature, Sharp>;
  p.ridges = add_stage(flow, RidgeStage{"ridges", 1, for_curves.hash, channel(CurveKind::ridge), "ridges", 0.2},
                       surface, curvature, sharp);
  p.valleys = add_stage(flow, RidgeStage{"ridges", 1, for_curves.hash, channel(CurveKind::valley), "valleys", 0.2},
                        surface, curvature, sharp);

  const auto curves = [options = for_curves.options](const Work& w, const Surface& s, const Ridges& r, const Ridges& v,
                                                     const Sharp& e) {
    return ridges_to_curves(w, s, r, v, e, options);
  };
  p.curves =
      add_stage(flow, Stage<Curves, Surface, Ridges, Ridges, Sharp>{"curves", 1, for_curves.hash, curves, {}, 0.5},
                surface, p.ridges, p.valleys, sharp);

  const Seen for_network = seen(StageGroup::network, all_options);
  const auto directions = [options = for_network.options](const Work& w, const Surface& s, const Curvature& k) {
    return curvature_to_directions(w, s, k, options);
  };
  const Port<Directions> guide = add_stage(
      flow, Stage<Directions, Surface, Curvature>{"network", 1, for_network.hash, directions, "directions", 0.1},
      surface, curvature);
  p.lines = add_stage(flow, Stage<Lines, Curvature>{"curvature", 1, 0, curvature_to_lines, "lines", 0.01}, curvature);
  const auto place = [read = source.read](const Work& w, const Soup& in, const Surface& s) {
    return read ? surface_to_guides(w, s, read(in)) : Guides{};
  };
  const Port<Guides> guides =
      add_stage(flow, Stage<Guides, Soup, Surface>{"network", 1, source.hash, place, "guides", 0.01}, soup, surface);
  p.goal = add_goal_stage(flow, all_options, surface, guide, p.lines, p.curves, guides);
  // The goal stands for the options it was found from.
  const auto with = [](LayoutOptions options, const Goal& goal) {
    options.patches = goal.patches, options.tolerance = {};
    return options;
  };
  const auto network = [with, options = for_network.options](const Work& w, const Surface& s, const Directions& d,
                                                             const Curves& c, const Guides& g, const Goal& goal) {
    return curves_to_network(w, s, d, c, g, with(options, goal));
  };
  using NetworkStage = Stage<Network, Surface, Directions, Curves, Guides, Goal>;
  p.network = add_stage(flow, NetworkStage{"network", 2, for_network.hash, network, {}, 1}, surface, guide, p.curves,
                        guides, p.goal);

  const Seen for_patches = seen(StageGroup::patches, all_options);
  const auto patches = [with, options = for_patches.options](const Work& w, const Surface& s, const Network& n,
                                                             const Goal& goal) {
    return network_to_patches(w, s, n, with(options, goal));
  };
  p.patches = add_stage(flow, Stage<Patches, Surface, Network, Goal>{"patches", 2, for_patches.hash, patches, {}, 1},
                        surface, p.network, p.goal);

  const Seen for_layout = seen(StageGroup::layout, all_options);
  const auto smoothing = [options = for_layout.options](const Work& w, const Surface& s, const Lines& l,
                                                        const Network& n, const Patches& q) {
    return patches_to_smoothing(w, s, l, n, q, options);
  };
  p.smoothing = add_stage(
      flow,
      Stage<Smoothing, Surface, Lines, Network, Patches>{"layout", 2, for_layout.hash, smoothing, "smoothing", 0.3},
      surface, p.lines, p.network, p.patches);
  const auto layout = [options = for_layout.options](const Work& w, const Surface& s, const Smoothing& a) {
    return smoothing_to_layout(w, s, a, options);
  };
  p.layout = add_stage(flow, Stage<Layout, Surface, Smoothing>{"layout", 2, for_layout.hash, layout, {}, 0.7}, surface,
                       p.smoothing);
  return p;
}

}  // namespace intarsia::graph
