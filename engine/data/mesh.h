// An oriented triangle surface in structure-of-arrays form, with the connectivity that kernels gather along.
// Corner c = 3 * face + i, i in 0..2; corners run counter-clockwise seen from outside.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/types.h"
#include "engine/data/csr.h"

namespace intarsia {

// Plain triangles as a file gives them. No connectivity, nothing cleaned.
struct Soup {
  std::vector<Real> x, y, z;
  std::vector<Index> corner;       // 3 per triangle
  std::vector<Index> source_face;  // triangle -> face of the file (differs where polygons were split); empty = identity

  Index vertex_count() const { return static_cast<Index>(x.size()); }
  Index face_count() const { return static_cast<Index>(corner.size() / 3); }
  Index source_of(Index triangle) const { return source_face.empty() ? triangle : source_face[triangle]; }
};

// Undirected edges are sorted by (smaller vertex, larger vertex); ids are therefore independent of threads.
struct MeshView {
  std::span<const Real> x, y, z;
  std::span<const Index> corner;     // 3 per face: vertex ids
  std::span<const Index> edge_v0;    // edge_v0[e] < edge_v1[e]
  std::span<const Index> edge_v1;
  std::span<const Index> edge_f0;    // adjacent faces, edge_f0[e] < edge_f1[e]
  std::span<const Index> edge_f1;    // kNone on a boundary edge
  std::span<const Index> face_edge;  // 3 per face: edge opposite corner i
  CsrView vertex_faces;              // ascending
  CsrView vertex_vertices;           // ascending

  Index vertex_count() const { return static_cast<Index>(x.size()); }
  Index face_count() const { return static_cast<Index>(corner.size() / 3); }
  Index edge_count() const { return static_cast<Index>(edge_v0.size()); }

  Vec3 point(Index v) const { return {x[v], y[v], z[v]}; }
  std::array<Index, 3> face(Index f) const { return {corner[3 * f], corner[3 * f + 1], corner[3 * f + 2]}; }
  bool is_boundary_edge(Index e) const { return edge_f1[e] == kNone; }
  // The face on the other side of edge e, or kNone.
  Index other_face(Index e, Index f) const { return edge_f0[e] == f ? edge_f1[e] : edge_f0[e]; }
  Index other_vertex(Index e, Index v) const { return edge_v0[e] == v ? edge_v1[e] : edge_v0[e]; }
  // The corner index (0..2) of vertex v in face f, or 3.
  int corner_of(Index f, Index v) const {
    for (int i = 0; i < 3; ++i)
      if (corner[3 * f + i] == v) return i;
    return 3;
  }
  // The edge between two vertices, or kNone. O(valence).
  Index edge_between(Index a, Index b) const {
    for (Index f : vertex_faces.row(a))
      for (int i = 0; i < 3; ++i) {
        const Index e = face_edge[3 * f + i];
        if ((edge_v0[e] == a && edge_v1[e] == b) || (edge_v0[e] == b && edge_v1[e] == a)) return e;
      }
    return kNone;
  }
};

struct Mesh {
  std::vector<Real> x, y, z;
  std::vector<Index> corner;
  std::vector<Index> edge_v0, edge_v1, edge_f0, edge_f1;
  std::vector<Index> face_edge;
  Csr vertex_faces, vertex_vertices;

  MeshView view() const {
    return {x, y, z, corner, edge_v0, edge_v1, edge_f0, edge_f1, face_edge, vertex_faces, vertex_vertices};
  }
  operator MeshView() const { return view(); }
  Index vertex_count() const { return static_cast<Index>(x.size()); }
  Index face_count() const { return static_cast<Index>(corner.size() / 3); }
  Index edge_count() const { return static_cast<Index>(edge_v0.size()); }
};

// Three component arrays with one Vec3 per element.
struct Vec3View {
  std::span<const Real> x, y, z;
  Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  std::size_t size() const { return x.size(); }
};

struct Vec3Array {
  std::vector<Real> x, y, z;

  Vec3Array() = default;
  explicit Vec3Array(std::size_t n) : x(n), y(n), z(n) {}
  void resize(std::size_t n) { x.resize(n), y.resize(n), z.resize(n); }
  std::size_t size() const { return x.size(); }
  Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, const Vec3& p) { x[i] = p.x(), y[i] = p.y(), z[i] = p.z(); }
  operator Vec3View() const { return {x, y, z}; }
  template <class F>
  void visit_fields(F&& f) {
    f(x), f(y), f(z);
  }
  template <class F>
  void visit_fields(F&& f) const {
    f(x), f(y), f(z);
  }
};

}  // namespace intarsia
