#include "graph/baseline_graph.h"

#include "engine/io/artefact_file.h"
#include "engine/parallel/for_each.h"
#include "kernels/baselines/exoskeleton.h"
#include "kernels/baselines/part_segmentation.h"
#include "kernels/baselines/qse.h"
#include "kernels/baselines/shape_diameter.h"
#include "kernels/baselines/slippage_segments.h"
#include "kernels/baselines/vsa.h"

namespace intarsia::graph {
namespace {

using namespace kernels;

PatchLabels parts_of(const Work& work, const Surface& surface, const FaceGraph& faces, Index patches,
                     std::span<const Index> parts) {
  if (!parts.empty()) return connected_pieces(faces, parts);
  PartOptions options;
  options.most = std::max(Index{1}, std::min(options.most, patches / 2));
  return segment_parts(work, surface.mesh, faces, shape_diameter(work, surface.mesh, faces, {}), options);
}

}  // namespace

const char* name_of(Baseline method) {
  switch (method) {
    case Baseline::vsa:
      return "VSA";
    case Baseline::qse:
      return "QSE-like";
    case Baseline::exoskeleton:
      return "ExoSkeleton-like";
    case Baseline::slippage:
      return "Slippage-like";
  }
  return "";
}

std::vector<Index> baseline_labels(const Work& work, const Surface& surface, Baseline method, Index patches,
                                   std::span<const Index> parts) {
  if (!parts.empty() && parts.size() != surface.mesh.face_count())
    throw Error(ErrorCode::bad_argument, "parts: " + std::to_string(parts.size()) + " numbers for a surface of " +
                                             std::to_string(surface.mesh.face_count()) + " triangles");
  const FaceGraph faces = make_face_graph(work, surface.mesh, surface.face_normal);
  switch (method) {
    case Baseline::vsa:
      return fit_planes(work, faces, {.patches = patches}).region;
    case Baseline::qse: {
      // As in the comparison of Cao, Yan, Wonka 2014: where quadrics need fewer patches, planes divide them.
      const QseFit fit = fit_quadrics(work, surface.mesh, faces, {.patches = patches, .same_within = 2e-3});
      return fit_parts(work, faces, {fit.region, fit.count()}, patches).patch_of_face;
    }
    case Baseline::exoskeleton:
      return fit_parts(work, faces, parts_of(work, surface, faces, patches, parts), patches).patch_of_face;
    case Baseline::slippage:
      return segment_by_slippage(work, faces, {.patches = patches}).patch_of_face;
  }
  throw Error(ErrorCode::internal, "no such baseline");
}

Patches baseline_patches(const Work& work, const Surface& surface, const Network& network, Baseline method,
                         Index patches, std::span<const Index> parts) {
  return patches_of_labels(work, network, surface, baseline_labels(work, surface, method, patches, parts));
}

BaselinePorts add_baseline_stages(Flow& flow, const Port<Soup>& soup, const LayoutOptions& options, Baseline method,
                                  PartsOfSoup parts) {
  const bool has_parts = static_cast<bool>(parts);
  Hash hash;
  hash.add(method), hash.add(exact_hash(options));
  BaselinePorts p;
  p.features = add_feature_stages(flow, soup, options);
  p.network = add_stage(flow, Stage<Network, Surface>{"network", 1, 0, empty_network, {}, 0.1}, p.features.surface);
  const auto patches = [method, wanted = options.patches, parts = std::move(parts)](
                           const Work& w, const Soup& input, const Surface& s, const Network& n) {
    std::vector<Index> own;
    if (parts) {
      const std::vector<Index> given = parts(input);
      for (const Index triangle : s.order.face) own.push_back(given[triangle]);
    }
    return baseline_patches(w, s, n, method, wanted, own);
  };
  Stage<Patches, Soup, Surface, Network> patches_stage{"patches", 1, hash.value(), patches, {}, 4};
  patches_stage.is_pure = !has_parts;  // those are read from somewhere
  p.patches = add_stage(flow, std::move(patches_stage), soup, p.features.surface, p.network);
  const Port<Lines> lines =
      add_stage(flow, Stage<Lines, Curvature>{"layout", 1, hash.value(), curvature_to_lines, "lines", 0.01},
                p.features.curvature);
  const auto smoothing = [options](const Work& w, const Surface& s, const Lines& l, const Network& n,
                                   const Patches& q) { return patches_to_smoothing(w, s, l, n, q, options); };
  using SmoothingStage = Stage<Smoothing, Surface, Lines, Network, Patches>;
  const Port<Smoothing> smoothed =
      add_stage(flow, SmoothingStage{"layout", 2, hash.value(), smoothing, "smoothing", 0.3}, p.features.surface, lines,
                p.network, p.patches);
  const auto layout = [options](const Work& w, const Surface& s, const Smoothing& a) {
    return smoothing_to_layout(w, s, a, options);
  };
  p.layout = add_stage(flow, Stage<Layout, Surface, Smoothing>{"layout", 2, hash.value(), layout, {}, 0.7},
                       p.features.surface, smoothed);
  return p;
}

}  // namespace intarsia::graph
