#include <algorithm>
#include <cmath>
#include <numeric>

#include "graph/stages.h"
#include "kernels/cells/merge_groups.h"
#include "kernels/cells/swap_cells.h"
#include "kernels/layout/trace_boundaries.h"
#include "kernels/patches/even_cells.h"
#include "kernels/patches/flood_patches.h"
#include "kernels/patches/measure_patches.h"
#include "kernels/patches/seed_by_error.h"

namespace intarsia::graph {
namespace {

using namespace kernels;

Patches from_subdivision(Subdivision&& s) {
  Patches p;
  p.labels = std::move(s.labels);
  p.on_network = std::move(s.on_network);
  p.edge_kind = std::move(s.edge_kind);
  p.network_patches = s.network_patches;
  p.merged_patches = s.merged_patches;
  p.warnings = std::move(s.warnings);
  return p;
}

// The subdivision that looks at the reconstruction error.
class ErrorDriven {
 public:
  ErrorDriven(const Work& work, const Surface& surface, const Network& network, const LayoutOptions& options)
      : work_(work),
        network_(network),
        options_(options),
        s_(make_patch_surface(work, network.refined, surface.face_normal, surface.detail, options.subdivide.hole_length,
                              network.locked)) {}

  // What the network encloses, without its tiny patches.
  PatchLabels network_labels(Patches& p) const {
    PatchLabels labels = flood_patches(work_, s_.mesh, network_.refined.on_network);
    p.network_patches = labels.count;
    if (options_.subdivide.merge_tiny) labels = merge_patches(work_, s_, labels, options_.subdivide.merge);
    p.merged_patches = labels.count;
    return labels;
  }

  // From `start` to `wanted` patches with refined borders. finished: the start already has its final number.
  void run(Patches& p, PatchLabels start, Index wanted, bool finished) {
    const SubdivideOptions& o = options_.subdivide;
    labels_ = std::move(start);
    if (!finished) {
      if (o.discs) labels_ = cut_to_discs(work_, s_, labels_, o.disc);
      seed(static_cast<Index>(std::ceil(options_.refine.over_segment * wanted)));
      if (labels_.count > wanted) merge(wanted);
    }
    refine();
    for (int round = 0; round < options_.refine.rounds && labels_.count == wanted; ++round)
      if (work_.is_late() || !reconsider(wanted)) break;
    if (options_.patches > 0 && labels_.count != wanted)
      p.warnings.push_back("wanted " + std::to_string(wanted) + " patches, got " + std::to_string(labels_.count) +
                           (reason_.empty() ? "" : ": " + reason_));
    mark_borders(work_, network_.refined, labels_, p.on_network, p.edge_kind);
    p.labels = std::move(labels_);
  }

 private:
  void seed(Index target) {
    if (labels_.count >= target) return;
    labels_ = seed_by_error(work_, s_, labels_, target, {options_.subdivide.split, {}});
    if (options_.subdivide.discs) labels_ = cut_to_discs(work_, s_, labels_, options_.subdivide.disc);
  }
  CellComplex complex_of(const PatchLabels& cells) const {
    const PatchTable table = measure_patches(work_, s_, cells);
    const LayoutGraph graph = trace_boundaries(work_, network_.refined, cells.patch_of_face, cells.count);
    return make_cell_complex(work_, network_.refined, cells, table, graph, options_.subdivide.hole_length,
                             options_.refine.cell);
  }
  GroupOptions group_options() const {
    GroupOptions group = options_.refine.group;
    group.discs = options_.subdivide.discs;
    group.perimeter =
        options_.form == SubdivideForm::quality ? options_.refine.quality_perimeter : options_.refine.compact_perimeter;
    return group;
  }
  void merge(Index target) {
    const CellComplex complex = complex_of(labels_);
    std::vector<Index> own(labels_.count);
    std::iota(own.begin(), own.end(), Index{0});
    Grouping grouping(work_, complex, std::move(own), labels_.count,
                      weights_.perimeter_weight > 0 ? weights_ : group_options());
    if (weights_.perimeter_weight == 0) grouping.weigh(target);
    reason_ = merge_groups(work_, target, grouping);
    labels_ = compact_labels(work_, grouping.spread(labels_.patch_of_face), grouping.alive());
  }
  void refine() {
    if (options_.refine.swap.sweeps == 0 || labels_.count < 2 || work_.is_late()) return;
    const EvenCells even = cut_even_cells(work_, s_, labels_, options_.refine.even);
    const CellComplex complex = complex_of(even.cells);
    Grouping grouping(work_, complex, even.patch_of_cell, labels_.count,
                      weights_.perimeter_weight > 0 ? weights_ : group_options());
    if (weights_.perimeter_weight == 0) {
      grouping.weigh(labels_.count);
      weights_ = grouping.options();
    }
    swap_cells(work_, options_.refine.swap, grouping);
    cost_ = grouping.total_cost_at(work_, options_.refine.judge_points);
    labels_ = compact_labels(work_, grouping.spread(even.cells.patch_of_face), grouping.alive());
  }
  // Patches where little is gained against patches where much is lost: some more seeds, merged back, refined.
  // Keeps what it finds if the whole is better.
  bool reconsider(Index wanted) {
    const PatchLabels before = labels_;
    const Real cost = cost_;
    seed(static_cast<Index>(std::ceil(options_.refine.reconsider * wanted)));
    if (labels_.count > wanted) merge(wanted);
    refine();
    if (labels_.count == wanted && cost_ < cost) return true;
    labels_ = before, cost_ = cost;
    return false;
  }

  const Work& work_;
  const Network& network_;
  const LayoutOptions& options_;
  PatchSurface s_;
  PatchLabels labels_;
  std::string reason_;
  GroupOptions weights_;  // as the first refinement found them
  Real cost_ = 0;         // after the last refinement, finely sampled
};

}  // namespace

Patches network_to_patches(const Work& work, const Surface& surface, const Network& network,
                           const LayoutOptions& options) {
  SubdivideOptions o = options.subdivide;
  o.patches = options.patches;
  // Without a number the paper's rules say how many and where; nothing is to be traded against anything.
  if (options.form == SubdivideForm::faithful || (options.form == SubdivideForm::compact && options.patches == 0))
    return from_subdivision(subdivide(work, network.refined, surface.face_normal, surface.detail, o, network.locked));
  Patches p;
  ErrorDriven driven(work, surface, network, options);
  if (options.patches > 0) {
    driven.run(p, driven.network_labels(p), options.patches, false);
    return p;
  }
  // Quality without a number: as many as the rules ask for.
  const Subdivision s = subdivide(work, network.refined, surface.face_normal, surface.detail, o, network.locked);
  driven.run(p, driven.network_labels(p), s.labels.count, false);
  p.warnings.insert(p.warnings.end(), s.warnings.begin(), s.warnings.end());
  return p;
}

Patches improve_patches(const Work& work, const Surface& surface, const Network& network, const PatchLabels& start,
                        const LayoutOptions& options) {
  Patches p;
  p.network_patches = p.merged_patches = start.count;
  ErrorDriven(work, surface, network, options).run(p, start, options.patches, start.count == options.patches);
  return p;
}

}  // namespace intarsia::graph
