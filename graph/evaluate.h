// How well the surface can be rebuilt from a layout's curve network alone: the paper's criterion. Lengths are in units
// of the bounding-box diagonal, since surfaces are normalised to it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "graph/artefacts.h"
#include "kernels/quality/reconstruct.h"
#include "kernels/quality/surface_distance.h"

namespace intarsia::graph {

struct EvaluateOptions {
  kernels::SampleOptions sample;
  LoopsOptions triangulated;  // the same start for the fills
  kernels::TransfiniteOptions transfinite;
  kernels::FillOptions filled;
  kernels::DistanceOptions distance;
  bool make_triangulated = true;
  bool make_triangulated_area = false;  // by plain area
  bool make_transfinite = true;
  bool make_filled = true;
};

// One way of rebuilding, and how far it is from the surface. Sums over both directions follow Metro: Hausdorff, mean
// and root mean square are the larger of the two one-sided values.
struct Rebuilt {
  bool made = false;
  kernels::Reconstruction surface;
  kernels::SurfaceDistance distance;         // forward: from the input to what was rebuilt
  std::vector<kernels::PartDistance> patch;  // per patch: input to rebuilt, over the input's faces of the patch
  Index failed = 0;                          // patches left out or fallen back
};

// Perimeter^2 / (4 pi area) of a patch, 1 for a flat disc: the reconstruction error can be bought with winding patches.
struct Compactness {
  std::vector<Real> patch;              // perimeter of the sampled arcs, area of the patch's faces
  Real median = 0, high = 0, most = 0;  // high: 90 % of the patches have no more
};

struct Evaluation {
  Rebuilt triangulated, triangulated_area, transfinite, filled;
  Compactness compactness;
  Index patches = 0;
  Index not_discs = 0;  // patches with other than one loop, which are bridged, or without any
  Index samples = 0;    // points of the sampled arcs

  // In the order of the options that ask for them; those that were made.
  std::vector<std::pair<std::string, const Rebuilt*>> made() const;
};

// mesh: the surface's mesh. refined, label, graph: the layout on a refinement of it.
// Errors: rejected if nothing could be rebuilt (a closed surface with a single patch has no curves).
Evaluation evaluate(const Work& work, const MeshView& mesh, const RefinedMesh& refined, std::span<const Index> label,
                    const LayoutGraph& graph, const EvaluateOptions& options);

inline Evaluation evaluate(const Work& work, const Surface& surface, const Layout& layout,
                           const EvaluateOptions& options) {
  return evaluate(work, surface.mesh, layout.refined, layout.labels.patch_of_face, layout.graph, options);
}

Compactness compactness_of(const kernels::SampledLayout& sampled, const MeshView& mesh, std::span<const Index> label);

}  // namespace intarsia::graph
