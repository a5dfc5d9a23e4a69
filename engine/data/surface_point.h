// A point of a triangle surface: on a vertex, on an edge, or inside a face.
#pragma once

#include <cstdint>

#include "engine/data/mesh.h"

namespace intarsia {

enum class PointKind : std::uint8_t { vertex = 0, edge = 1, face = 2 };

struct SurfacePoint {
  PointKind kind = PointKind::vertex;
  Index element = kNone;  // vertex, edge or face id, by kind
  Real a = 0, b = 0;      // edge: a = position from edge_v0 (0..1); face: barycentric weights of corners 0 and 1

  static SurfacePoint at_vertex(Index v) { return {PointKind::vertex, v, 0, 0}; }
  static SurfacePoint on_edge(Index e, Real t) { return {PointKind::edge, e, t, 0}; }
  static SurfacePoint in_face(Index f, Real u, Real v) { return {PointKind::face, f, u, v}; }
  bool operator==(const SurfacePoint&) const = default;
};

inline Vec3 position(const MeshView& mesh, const SurfacePoint& p) {
  switch (p.kind) {
    case PointKind::vertex: return mesh.point(p.element);
    case PointKind::edge:
      return (1 - p.a) * mesh.point(mesh.edge_v0[p.element]) + p.a * mesh.point(mesh.edge_v1[p.element]);
    case PointKind::face: {
      const auto [i, j, k] = mesh.face(p.element);
      return p.a * mesh.point(i) + p.b * mesh.point(j) + (1 - p.a - p.b) * mesh.point(k);
    }
  }
  return Vec3::Zero();
}

}  // namespace intarsia
