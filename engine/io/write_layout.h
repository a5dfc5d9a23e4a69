// The layout as files in the user's numbering: patches.ply, layout.ply, network.ply, network.json (docs/formats.md).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "engine/data/curve_network.h"
#include "engine/data/layout_graph.h"
#include "engine/data/mesh.h"
#include "engine/data/patch_labels.h"
#include "engine/parallel/work.h"

namespace intarsia {

// Views of all that the files are made from. Canonical numbers are those of the mesh the method ran on.
struct LayoutView {
  const Soup* soup = nullptr;           // as read
  std::span<const Index> vertex_order;  // canonical vertex -> soup vertex, kNone where it is none
  std::span<const Index> face_order;    // canonical face -> soup triangle
  std::span<const Index> copies;  // canonical vertices that are further copies of a soup vertex, or none: ascending
  bool divided = false;           // several canonical faces may be one soup triangle
  std::span<const Index> twin;    // soup triangles that repeat twin_of[i]: labelled as those
  std::span<const Index> twin_of;
  Vec3 centre = Vec3::Zero();  // input position = centre + diagonal * normalised position
  Real diagonal = 1;
  const RefinedMesh* refined = nullptr;    // of the canonical mesh
  const PatchLabels* labels = nullptr;     // of the refined faces
  const LayoutGraph* graph = nullptr;      // on the refined mesh
  const CurveNetwork* interior = nullptr;  // feature curves inside patches, on the canonical mesh
  MeshView mesh;                           // the canonical mesh
  Vec3View given;  // input positions of its vertices, normalised, where the mesh has others; else empty
  std::span<const Index> face_patch;  // canonical face -> patch with most of it
  std::span<const std::array<std::uint8_t, 3>> patch_colour;
};

// Patch of every soup triangle: the one with most of its area, ties to the smaller id; kNone where cleaning left it
// out.
std::vector<Index> input_patches(const Work& work, const LayoutView& layout);

// The faces of layout.ply, as numbers of refined faces: ascending by input triangle, in refined order inside one.
std::vector<Index> layout_faces(const Work& work, const LayoutView& layout);

// Vertices of layout.ply: the soup's, then copies, then new ones.
inline Index layout_vertex_count(const LayoutView& l) {
  return l.soup->vertex_count() + static_cast<Index>(l.copies.size()) + l.refined->mesh.vertex_count() -
         static_cast<Index>(l.vertex_order.size());
}

// Errors of all: write_failed naming the file, numeric, cancelled.

// The input's vertices and triangles in its order; faces with int patch (-1: left out by cleaning), uchar red green
// blue, and int source_face if polygons were split. Coordinates are double where float would round them.
void write_patches_ply(const Work& work, const std::filesystem::path& path, const LayoutView& layout);

// The refinement whose edges carry all curves: the input's vertices first, in its order, then copies, then new ones;
// faces with int patch and int parent (triangle of the input), ascending by parent.
void write_layout_ply(const Work& work, const std::filesystem::path& path, const LayoutView& layout);

// Vertices of the network and its edges with int vertex1 vertex2 curve kind; curve = arc of network.json.
void write_network_ply(const Work& work, const std::filesystem::path& path, const LayoutView& layout);

// Nodes, arcs, loops per patch, interior curves. Vertex ids are those of layout.ply.
void write_network_json(const Work& work, const std::filesystem::path& path, const LayoutView& layout);

// Where a point of the canonical mesh is on the input; `here`: where it is on the mesh.
inline Vec3 given_position(const LayoutView& l, const SurfacePoint& p, const Vec3& here) {
  if (l.given.size() == 0) return here;
  MeshView input = l.mesh;
  input.x = l.given.x, input.y = l.given.y, input.z = l.given.z;
  return position(input, p);
}

// Number of a refined vertex in layout.ply.
inline Index layout_vertex(const LayoutView& l, Index v) {
  const Index originals = static_cast<Index>(l.vertex_order.size());
  const Index given = l.soup->vertex_count(), copies = static_cast<Index>(l.copies.size());
  if (v >= originals) return given + copies + v - originals;
  const auto copy = std::lower_bound(l.copies.begin(), l.copies.end(), v);
  if (copy != l.copies.end() && *copy == v) return given + static_cast<Index>(copy - l.copies.begin());
  return l.vertex_order[v];
}

// Position of a refined vertex in the input's units: the input's own bits where it is an input vertex.
inline Vec3 layout_point(const LayoutView& l, Index v) {
  if (v < l.vertex_order.size() && l.vertex_order[v] != kNone) {
    const Index s = l.vertex_order[v];
    return {l.soup->x[s], l.soup->y[s], l.soup->z[s]};
  }
  return l.centre + l.diagonal * given_position(l, l.refined->origin[v], l.refined->mesh.view().point(v));
}

// Position of a vertex of layout.ply.
inline Vec3 layout_point_by_number(const LayoutView& l, Index v) {
  const Soup& soup = *l.soup;
  const Index given = soup.vertex_count(), copies = static_cast<Index>(l.copies.size());
  if (v < given) return {soup.x[v], soup.y[v], soup.z[v]};
  const Index i = v - given;
  return layout_point(l, i < copies ? l.copies[i] : static_cast<Index>(l.vertex_order.size()) + i - copies);
}

}  // namespace intarsia
