// The surface that view.html shows: the layout's refined mesh, made coarser where it is large.
#pragma once

#include "engine/parallel/work.h"
#include "tools/export/handover.h"

namespace intarsia::tools {

struct PageSurface {
  std::vector<Index> corner;       // vertices of this surface, faces by patch
  std::vector<Index> patch_faces;  // patch -> number of faces
  std::vector<Index> source;       // vertex -> refined vertex: itself, or one of those it stands for
  std::vector<Vec3> point;         // normalised
  bool is_coarse = false;
};

// Vertices in the order in which the faces first use them.
// Where the mesh has more than most_faces, vertices inside a patch that share a cell of a grid become one, at their
// mean; vertices of arcs stay, so that borders keep their course. Linear but for a sort.
PageSurface page_surface(const Work& work, const LayoutView& layout, std::size_t most_faces);

}  // namespace intarsia::tools
