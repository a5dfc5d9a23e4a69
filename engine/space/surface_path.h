// Moving on a triangle surface: incidence of surface points, a walk towards a target, plane sections between two
// points.
#pragma once

#include <array>
#include <vector>

#include "engine/data/surface_point.h"

namespace intarsia {

// A point of a face by the weights of its three corners (non-negative, sum 1).
struct FacePoint {
  Index face = kNone;
  std::array<Real, 3> weight{};
};

inline Vec3 position(const MeshView& mesh, const FacePoint& p) {
  const auto [i, j, k] = mesh.face(p.face);
  return p.weight[0] * mesh.point(i) + p.weight[1] * mesh.point(j) + p.weight[2] * mesh.point(k);
}

// Twice the area of a face times its unit normal; zero for a degenerate face.
inline Vec3 area_normal(const MeshView& mesh, Index f) {
  const auto [i, j, k] = mesh.face(f);
  return (mesh.point(j) - mesh.point(i)).cross(mesh.point(k) - mesh.point(i));
}

// True if p lies on face f (closed).
bool is_on_face(const MeshView& mesh, const SurfacePoint& p, Index f);

// The weights of p in face f. Requires: is_on_face.
std::array<Real, 3> weights_in_face(const MeshView& mesh, const SurfacePoint& p, Index f);

// p as a point of its smallest incident face. Requires: a vertex has at least one face.
FacePoint to_face_point(const MeshView& mesh, const SurfacePoint& p);

// Faces that contain both points: at most two, ascending, kNone behind the last. Two if both lie on one inner edge.
std::array<Index, 2> shared_faces(const MeshView& mesh, const SurfacePoint& p, const SurfacePoint& q);

// Walks from p towards `target`, which is projected anew to the plane of every face entered. Stops at the projection,
// at the mesh boundary, in a crease where both sides point back at each other, or at a degenerate face.
FacePoint walk_towards(const MeshView& mesh, FacePoint p, const Vec3& target);

// Appends the edge crossings of the plane section that joins two points; the plane contains both points and the mean of
// their normals. Nothing is appended when the points share a face. Returns false (and appends nothing) if the section
// does not reach `to`. Requires: face points lie strictly inside their face.
// Ensures: every appended point lies on an edge with `margin` <= a <= 1 - margin; neighbours in the path share a face.
bool section_crossings(const MeshView& mesh, const SurfacePoint& from, const SurfacePoint& to, Real margin,
                       std::vector<SurfacePoint>& crossings);

}  // namespace intarsia
