#include "kernels/cells/inward_directions.h"

#include <algorithm>
#include <vector>

namespace intarsia::kernels {
namespace {

constexpr int kPasses = 3;

Vec3 area_normal(const MeshView& mesh, Index f) {
  const auto [a, b, c] = mesh.face(f);
  return (mesh.point(b) - mesh.point(a)).cross(mesh.point(c) - mesh.point(a));
}

Vec3 unit_or_zero(const Vec3& v) {
  const Real length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

class ArcSide {
 public:
  ArcSide(const MeshView& mesh, std::span<const Index> vertex, bool left)
      : mesh_(mesh), vertex_(vertex), sorted_(vertex.begin(), vertex.end()), sign_(left ? 1 : -1) {
    std::sort(sorted_.begin(), sorted_.end());
  }

  // Of the faces on this side of vertex i: those of the second ring, else those around it.
  Vec3 normal(std::size_t i) const {
    const Index v = vertex_[i];
    const Vec3 along =
        mesh_.point(vertex_[std::min(i + 1, vertex_.size() - 1)]) - mesh_.point(vertex_[i == 0 ? 0 : i - 1]);
    Vec3 middle = Vec3::Zero(), near = Vec3::Zero(), far = Vec3::Zero();
    for (const Index f : mesh_.vertex_faces.row(v)) middle += area_normal(mesh_, f);
    const Vec3 away = sign_ * middle.cross(along);
    const auto is_on_side = [&](Index f) {
      const auto [a, b, c] = mesh_.face(f);
      return away.dot(mesh_.point(a) + mesh_.point(b) + mesh_.point(c) - 3 * mesh_.point(v)) > 0;
    };
    for (const Index f : mesh_.vertex_faces.row(v)) {
      if (!is_on_side(f)) continue;
      near += area_normal(mesh_, f);
      for (const Index w : mesh_.face(f)) {
        if (is_on_arc(w)) continue;
        for (const Index g : mesh_.vertex_faces.row(w)) {
          const auto [a, b, c] = mesh_.face(g);
          if (a != v && b != v && c != v && is_on_side(g)) far += area_normal(mesh_, g);
        }
      }
    }
    return unit_or_zero(far.squaredNorm() > 0 ? far : near);
  }

 private:
  bool is_on_arc(Index v) const { return std::binary_search(sorted_.begin(), sorted_.end(), v); }

  const MeshView& mesh_;
  std::span<const Index> vertex_;
  std::vector<Index> sorted_;  // borders of patches of a large scan have thousands
  Real sign_;
};

}  // namespace

void inward_directions(const MeshView& mesh, std::span<const Index> vertex, std::span<const Vec3> shape, bool left,
                       std::span<Vec3> inward) {
  const std::size_t n = vertex.size();
  const ArcSide side(mesh, vertex, left);
  std::vector<Vec3> normal(n);
  // Ends are corners, with faces of other patches around them: like their neighbours, if there are any.
  if (n == 2)
    normal = {side.normal(0), side.normal(1)};
  else
    for (std::size_t i = 1; i + 1 < n; ++i) normal[i] = side.normal(i);
  if (n > 2) normal[0] = normal[1], normal[n - 1] = normal[n - 2];
  std::vector<Vec3> next(normal);
  for (int pass = 0; pass < kPasses; ++pass) {
    for (std::size_t i = 1; i + 1 < n; ++i) next[i] = unit_or_zero(normal[i - 1] + 2 * normal[i] + normal[i + 1]);
    normal.swap(next);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 along = shape[std::min(i + 1, n - 1)] - shape[i == 0 ? 0 : i - 1];
    const Vec3 leftward = normal[i].cross(along);
    inward[i] = unit_or_zero(left ? leftward : Vec3(-leftward));
  }
}

}  // namespace intarsia::kernels
