// The promises that every layout keeps, each as a check of its own with a count and an example.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/data/layout_graph.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct CheckOptions {
  Real area_tolerance = 1e-6;  // relative
  Real hole_length = 0.05;     // boundary loops of the input shorter than this (diagonal = 1) count as filled
};

struct LayoutCheck {
  std::string name;
  std::string element;      // what the example is: face, edge, vertex, patch, or parent (face of the input)
  Index count = 0;          // how many elements fail; 0 = passed
  Index example = kNone;    // the smallest id that fails
  bool is_warning = false;  // a failure does not make the layout invalid

  bool passed() const { return count == 0; }
};

struct LayoutChecks {
  std::vector<LayoutCheck> checks;  // in the order of the list below
  Real area_error = 0;              // |area - area of the input| / area of the input
  std::int64_t euler = 0;           // V - E + F of the refined mesh

  bool is_valid() const;
  const LayoutCheck& operator[](std::string_view name) const;  // Errors: internal if there is no such check
};

// faces_labelled     every face has a label below patch_count
// patches_connected  every patch has faces, all reachable from each other inside the patch (across edges)
// no_loose_ends      no vertex with exactly one network or boundary edge
// edges_separate     a network edge is on the boundary or has two different patches
// borders_on_network an edge between two patches, or on the boundary, is on the network
// area               the total area is the input's
// inside_parent      corners lie on the parent and where their origin says, the orientation is the parent's
// parents_covered    the refined faces of every input face cover its area
// finite             no NaN or infinity in positions and origins
// loops_consistent   nodes - arcs + Euler characteristics of the patches = V - E + F of the mesh
// patches_discs      (warning) one border loop, Euler characteristic 1, no vertex touched twice; filled holes not
// counted Requires: original and refined connected; graph traced from the same labels (it is not read where labels
// fail).
LayoutChecks check_layout(const Work& work, MeshView original, const RefinedMesh& refined, std::span<const Index> label,
                          Index patch_count, const LayoutGraph& graph, const CheckOptions& options = {});

}  // namespace intarsia::kernels
