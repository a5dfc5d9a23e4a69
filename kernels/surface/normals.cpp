#include "kernels/surface/normals.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "engine/parallel/reduce.h"

namespace intarsia::kernels {
namespace {

// Adds the Max weight of face f seen from v.
void add_weighted(const MeshView& mesh, Index f, Index v, Vec3& sum) {
  const auto [i, j, k] = mesh.face(f);
  const Vec3 p = mesh.point(v);
  const bool first = i == v, second = j == v;  // which of the corners is v cannot be predicted: no branches
  const Vec3 a = mesh.point(first ? j : second ? k : i) - p;
  const Vec3 b = mesh.point(first ? k : second ? i : j) - p;
  const Real w = a.squaredNorm() * b.squaredNorm();
  if (w > 0) sum += a.cross(b) / w;
}

// Normalises `sum` unless cancellation has left nothing of terms of total size `scale`.
bool to_unit(Vec3& sum, Real scale) {
  const Real length = sum.norm();
  if (!(length > 1e-12 * scale) || !std::isfinite(length)) return false;
  sum /= length;
  return true;
}

bool max_normal(const MeshView& mesh, const FaceGeometry& faces, Index v, Vec3& n) {
  n = Vec3::Zero();
  Real scale = 0;
  for (Index f : mesh.vertex_faces.row(v)) {
    if (faces.area[f] == 0) continue;
    Vec3 term = Vec3::Zero();
    add_weighted(mesh, f, v, term);
    n += term;
    scale += term.norm();
  }
  return to_unit(n, scale);
}

bool area_normal(const MeshView& mesh, const FaceGeometry& faces, Index v, Vec3& n) {
  n = Vec3::Zero();
  Real total = 0, largest = 0;
  Index of = kNone;
  for (Index f : mesh.vertex_faces.row(v)) {
    n += faces.area[f] * faces.normal[f];
    total += faces.area[f];
    if (faces.area[f] > largest) largest = faces.area[f], of = f;
  }
  if (to_unit(n, total)) return true;
  if (of == kNone) return false;
  n = faces.normal[of];
  return true;
}

Vec3 neighbour_normal(const MeshView& mesh, const FaceGeometry& faces, Index v) {
  Vec3 n = Vec3::Zero();
  Real total = 0;
  for (Index w : mesh.vertex_vertices.row(v))
    for (Index f : mesh.vertex_faces.row(w)) n += faces.area[f] * faces.normal[f], total += faces.area[f];
  return to_unit(n, total) ? n : Vec3(Vec3::UnitZ());
}

}  // namespace

FaceGeometry face_geometry(const Work& work, const MeshView& mesh) {
  const std::size_t n = mesh.face_count();
  FaceGeometry out{Vec3Array(n), std::vector<Real>(n), Vec3Array(n)};
  for_each(work, Cost::light, n, [&](std::size_t f) {
    const auto [i, j, k] = mesh.face(static_cast<Index>(f));
    const Vec3 p = mesh.point(i), a = mesh.point(j) - p, b = mesh.point(k) - p;
    const Vec3 cross = a.cross(b);
    const Real length = cross.norm();
    const Real longest = std::sqrt(std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()}));
    out.centroid.set(f, p + (a + b) / 3);
    if (length > kFlatHeight * longest) {
      out.normal.set(f, cross / length);
      out.area[f] = length / 2;
    }
  });
  return out;
}

Vec3Array vertex_normals(const Work& work, const MeshView& mesh, const FaceGeometry& faces) {
  Vec3Array out(mesh.vertex_count());
  for_each(work, Cost::light, mesh.vertex_count(), [&](std::size_t i) {
    const Index v = static_cast<Index>(i);
    Vec3 n;
    if (!max_normal(mesh, faces, v, n) && !area_normal(mesh, faces, v, n)) n = neighbour_normal(mesh, faces, v);
    out.set(i, n);
  });
  return out;
}

Real mean_edge_length(const Work& work, const MeshView& mesh) {
  const Index n = mesh.edge_count();
  if (n == 0) return 0;
  const Real total = sum(work, Cost::light, n, Real{0}, [&](std::size_t e) {
    return (mesh.point(mesh.edge_v1[e]) - mesh.point(mesh.edge_v0[e])).norm();
  });
  return total / n;
}

}  // namespace intarsia::kernels
