#include "graph/compare_methods.h"

#include <array>

#include "graph/baseline_graph.h"
#include "graph/empty_network.h"
#include "graph/stages.h"

namespace intarsia::graph {
namespace {

struct Named {
  Method method;
  const char* name;
  const char* flag;
};

constexpr std::array kNames{
    Named{Method::compact, "ours, compact", "compact"},
    Named{Method::quality, "ours, quality", "quality"},
    Named{Method::faithful, "ours, faithful", "faithful"},
    Named{Method::vsa, "VSA", "vsa"},
    Named{Method::vsa_refined, "VSA + refinement", "vsa-refined"},
    Named{Method::vsa_seeded, "VSA + seeds + refinement", "vsa-seeded"},
    Named{Method::vsa_merged, "VSA + merging + refinement", "vsa-merged"},
    Named{Method::qse, "QSE-like", "qse"},
    Named{Method::exoskeleton, "ExoSkeleton-like", "exoskeleton"},
    Named{Method::slippage, "slippage-like", "slippage"},
};

const Named& named(Method method) {
  for (const Named& n : kNames)
    if (n.method == method) return n;
  return kNames[0];
}

Patches baseline_by(const Work& work, const Prepared& p, const Network& network, Method method,
                    const LayoutOptions& options) {
  LayoutOptions as_they_come = options;
  as_they_come.subdivide.discs = false;
  const auto plain = [&](Index count) { return baseline_patches(work, p.surface, network, Baseline::vsa, count); };
  switch (method) {
    case Method::vsa_refined:
      as_they_come.form = SubdivideForm::compact;
      return improve_patches(work, p.surface, network, plain(options.patches).labels, as_they_come);
    case Method::vsa_seeded:
      as_they_come.form = SubdivideForm::compact;
      return network_to_patches(work, p.surface, network, as_they_come);
    case Method::vsa_merged: {
      as_they_come.form = SubdivideForm::quality;
      const Index more = static_cast<Index>(options.refine.over_segment * options.patches);
      return improve_patches(work, p.surface, network, plain(more).labels, as_they_come);
    }
    case Method::qse:
      return baseline_patches(work, p.surface, network, Baseline::qse, options.patches);
    case Method::exoskeleton:
      return baseline_patches(work, p.surface, network, Baseline::exoskeleton, options.patches);
    case Method::slippage:
      return baseline_patches(work, p.surface, network, Baseline::slippage, options.patches);
    default:
      return plain(options.patches);
  }
}

}  // namespace

std::vector<Method> all_methods() {
  std::vector<Method> all;
  all.reserve(kNames.size());
  for (const Named& n : kNames) all.push_back(n.method);
  return all;
}

std::string name_of(Method method) { return named(method).name; }
std::string short_name_of(Method method) { return named(method).flag; }
bool is_ours(Method m) { return m == Method::compact || m == Method::quality || m == Method::faithful; }

Prepared prepare(const Work& work, const Soup& soup, const LayoutOptions& options) {
  Prepared p;
  p.surface = mesh_to_surface(work, soup, options);
  p.sharp = surface_to_sharp(work, p.surface, options);
  const Scale scale = surface_to_scale(work, p.surface, p.sharp, options);
  p.curvature = scale_to_curvature(work, p.surface, scale, p.sharp, options);
  const Ridges ridges = curvature_to_ridges(work, p.surface, p.curvature, p.sharp, CurveKind::ridge, options);
  const Ridges valleys = curvature_to_ridges(work, p.surface, p.curvature, p.sharp, CurveKind::valley, options);
  p.curves = ridges_to_curves(work, p.surface, ridges, valleys, p.sharp, options);
  return p;
}

Layout layout_by(const Work& work, const Prepared& p, Method method, const LayoutOptions& options) {
  LayoutOptions o = options;
  if (is_ours(method)) {
    o.form = method == Method::compact   ? SubdivideForm::compact
             : method == Method::quality ? SubdivideForm::quality
                                         : SubdivideForm::faithful;
    const Directions directions = curvature_to_directions(work, p.surface, p.curvature, o);
    const Network network = curves_to_network(work, p.surface, directions, p.curves, {}, o);
    const Patches patches = network_to_patches(work, p.surface, network, o);
    return patches_to_layout(work, p.surface, p.curvature, network, patches, o);
  }
  const Network network = empty_network(work, p.surface);
  const Patches patches = baseline_by(work, p, network, method, o);
  return patches_to_layout(work, p.surface, p.curvature, network, patches, o);
}

}  // namespace intarsia::graph
