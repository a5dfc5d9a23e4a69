// The stages of the method in order: the table of contents. Each is a pure function of its inputs and options;
// layout_graph.cpp wires them.
//
//   read -> surface -> sharp -> scale -> curvature -> ridges + valleys -> curves -> network -> patches -> layout ->
//   write
#pragma once

#include "engine/parallel/work.h"
#include "graph/artefacts.h"
#include "graph/options.h"

namespace intarsia::graph {

// Cleans it first. Errors: rejected, in the user's numbering.
Surface mesh_to_surface(const Work& work, const Soup& soup, const LayoutOptions& options = {});
Sharp surface_to_sharp(const Work& work, const Surface& surface, const LayoutOptions& options);
Scale surface_to_scale(const Work& work, const Surface& surface, const Sharp& sharp, const LayoutOptions& options);
Curvature scale_to_curvature(const Work& work, const Surface& surface, const Scale& scale, const Sharp& sharp,
                             const LayoutOptions& options);
Directions curvature_to_directions(const Work& work, const Surface& surface, const Curvature& curvature,
                                   const LayoutOptions& options);
Lines curvature_to_lines(const Work& work, const Curvature& curvature);
// channel: ridge or valley.
Ridges curvature_to_ridges(const Work& work, const Surface& surface, const Curvature& curvature, const Sharp& sharp,
                           CurveKind channel, const LayoutOptions& options);
Curves ridges_to_curves(const Work& work, const Surface& surface, const Ridges& ridges, const Ridges& valleys,
                        const Sharp& sharp, const LayoutOptions& options);
Network curves_to_network(const Work& work, const Surface& surface, const Directions& directions, const Curves& curves,
                          const Guides& guides, const LayoutOptions& options);
// options.patches, or with a tolerance the smallest number whose layout rebuilds the surface within it: found by making
// such layouts.
Goal curves_to_goal(const Work& work, const Surface& surface, const Directions& directions, const Lines& lines,
                    const Curves& curves, const Guides& guides, const LayoutOptions& options);
Patches network_to_patches(const Work& work, const Surface& surface, const Network& network,
                           const LayoutOptions& options);
// The same seeds, merging and border refinement from any patches, for comparisons: from `start` to options.patches.
// With that many already only borders are refined. Requires: options.form is not faithful.
Patches improve_patches(const Work& work, const Surface& surface, const Network& network, const PatchLabels& start,
                        const LayoutOptions& options);
Smoothing patches_to_smoothing(const Work& work, const Surface& surface, const Lines& lines, const Network& network,
                               const Patches& patches, const LayoutOptions& options);
Layout smoothing_to_layout(const Work& work, const Surface& surface, const Smoothing& smoothing,
                           const LayoutOptions& options);
// Both, and the lines.
Layout patches_to_layout(const Work& work, const Surface& surface, const Curvature& curvature, const Network& network,
                         const Patches& patches, const LayoutOptions& options);

}  // namespace intarsia::graph
