// What the writers of this folder are given: a layout in the user's numbers and units, and what else is known of it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/io/write_layout.h"
#include "tools/export/feature_lines.h"

namespace intarsia::tools {

struct Handover {
  LayoutView layout;               // edge_kind and on_network of its refined mesh may be empty
  std::vector<Index> input_patch;  // triangle of the input -> patch, as in patches.ply; kNone (-1 in files): left out
  bool single = false;             // the input's coordinates are all floats
  const FeatureLines* features = nullptr;  // none where only a result folder is known
  std::string name;                        // of the input, for titles

  Index patch_count() const { return layout.graph->patch_count(); }
  // Vertices of the layout in the numbers of layout.ply.
  Index layout_vertex_count() const {
    return layout.soup->vertex_count() + layout.refined->mesh.vertex_count() -
           static_cast<Index>(layout.vertex_order.size());
  }
  Vec3 input_point(Index v) const { return {layout.soup->x[v], layout.soup->y[v], layout.soup->z[v]}; }
  // Position of a vertex of layout.ply.
  Vec3 point(Index v) const {
    const Index given = layout.soup->vertex_count();
    if (v < given) return input_point(v);
    return layout_point(layout, v - given + static_cast<Index>(layout.vertex_order.size()));
  }
  // Corner of a refined face as a vertex of layout.ply.
  Index corner(std::size_t c) const { return layout_vertex(layout, layout.refined->mesh.corner[c]); }
};

// Fills input_patch and single from the layout.
void complete(const Work& work, Handover& handover);

}  // namespace intarsia::tools
