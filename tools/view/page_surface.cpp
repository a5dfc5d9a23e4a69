#include "tools/view/page_surface.h"

#include <cmath>

#include "engine/parallel/sort.h"

namespace intarsia::tools {
namespace {

struct Coarse {
  std::vector<Index> stands_for;  // refined vertex -> the vertex that takes its place
  std::vector<Vec3> point;        // of those
};

Real area_of(const MeshView& mesh) {
  Real area = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto [i, j, k] = mesh.face(f);
    area += (mesh.point(j) - mesh.point(i)).cross(mesh.point(k) - mesh.point(i)).norm() / 2;
  }
  return area;
}

struct Member {
  std::uint64_t cell = 0;
  Index patch = 0, vertex = 0;
  auto operator<=>(const Member&) const = default;
};

Coarse merge_vertices(const Work& work, const LayoutView& layout, std::size_t most_faces) {
  const MeshView mesh = layout.refined->mesh;
  const Real cell = std::sqrt(3 * area_of(mesh) / static_cast<Real>(most_faces));
  Coarse coarse;
  coarse.stands_for.resize(mesh.vertex_count()), coarse.point.resize(mesh.vertex_count());
  std::vector<Index> patch(mesh.vertex_count(), kNone);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (const Index v : mesh.face(f)) patch[v] = layout.labels->patch_of_face[f];
  for (const Index v : layout.graph->arc.item) patch[v] = kNone;
  std::vector<Member> member;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    coarse.stands_for[v] = v, coarse.point[v] = mesh.point(v);
    if (patch[v] == kNone) continue;
    std::uint64_t key = 0;  // normalised coordinates lie in [-1/2, 1/2]
    for (int i = 0; i < 3; ++i)
      key = key << 21 | (static_cast<std::uint64_t>(std::floor((mesh.point(v)[i] + 1) / cell)) & ((1u << 21) - 1));
    member.push_back({key, patch[v], v});
  }
  sort_total(work, member.begin(), member.end());
  for (std::size_t i = 0, end = 0; i < member.size(); i = end) {
    Vec3 sum = Vec3::Zero();
    for (end = i; end < member.size() && member[end].cell == member[i].cell && member[end].patch == member[i].patch;
         ++end) {
      sum += mesh.point(member[end].vertex);
      coarse.stands_for[member[end].vertex] = member[i].vertex;
    }
    coarse.point[member[i].vertex] = sum / static_cast<Real>(end - i);
  }
  return coarse;
}

}  // namespace

PageSurface page_surface(const Work& work, const LayoutView& layout, std::size_t most_faces) {
  const MeshView mesh = layout.refined->mesh;
  PageSurface out;
  out.is_coarse = mesh.face_count() > most_faces;
  const Coarse coarse = out.is_coarse ? merge_vertices(work, layout, most_faces) : Coarse();
  const Csr faces = faces_of_patches(*layout.labels);
  std::vector<Index> number(mesh.vertex_count(), kNone);
  for (Index p = 0; p < faces.rows(); ++p) {
    out.patch_faces.push_back(0);
    for (const Index f : faces.row(p)) {
      auto corner = mesh.face(f);
      if (out.is_coarse)
        for (Index& v : corner) v = coarse.stands_for[v];
      if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
      ++out.patch_faces.back();
      for (const Index v : corner) {
        if (number[v] == kNone) {
          number[v] = static_cast<Index>(out.source.size());
          out.source.push_back(v);
          out.point.push_back(out.is_coarse ? coarse.point[v] : mesh.point(v));
        }
        out.corner.push_back(number[v]);
      }
    }
    work.check();
  }
  return out;
}

}  // namespace intarsia::tools
