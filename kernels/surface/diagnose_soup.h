// What a triangle soup is like: counts, topology, and everything that keeps it from being a surface, with the first
// offenders. Unlike check_soup it never refuses: it is what `intarsia info` prints.
#pragma once

#include <cstdint>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"
#include "kernels/surface/fault.h"

namespace intarsia::kernels {

struct SoupDiagnosis {
  std::uint64_t vertices = 0, triangles = 0, edges = 0;
  std::uint64_t components = 0;    // of triangles connected through vertices
  std::uint64_t border_edges = 0;  // of one triangle
  std::uint64_t border_loops = 0;  // connected pieces of border edges
  std::int64_t genus = -1;         // of all components together; -1 where edges are shared by three triangles or more,
                                   // orientations disagree, or fans touch
  Fault isolated_vertices;         // of no triangle
  Fault repeated_corners;          // triangles with a corner twice
  Fault zero_area;                 // triangles with three corners and no area (1e-14 of the squared diagonal)
  Fault duplicate_triangles;       // the same three corners as a triangle before
  Fault non_manifold_edges;        // shared by three triangles or more; named by their smallest triangle
  Fault turned_edges;              // two triangles that run along it in the same direction; likewise
  Fault several_fans;              // vertices whose triangles form more than one fan
  Real diagonal = 0, area = 0;     // model units
  Real edge_mean = 0, edge_least = 0, edge_most = 0;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // bounding box of used vertices

  bool is_surface() const {
    return repeated_corners.count + non_manifold_edges.count + turned_edges.count + several_fans.count == 0;
  }
};

// Requires: corners in range, coordinates finite (as read_mesh ensures). Bits do not depend on threads.
SoupDiagnosis diagnose_soup(const Work& work, const Soup& soup);

}  // namespace intarsia::kernels
