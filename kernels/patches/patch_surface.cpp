#include "kernels/patches/patch_surface.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/compact.h"
#include "engine/parallel/reduce.h"
#include "kernels/patches/flood_patches.h"

namespace intarsia::kernels {
namespace {

// Area of the component that each boundary edge belongs to.
std::vector<Real> component_areas(const Work& work, const PatchSurface& s, std::vector<Index>& component) {
  const std::vector<Index> zero(s.mesh.face_count(), 0);
  PatchLabels pieces = flood_equal(work, s.mesh, zero);
  std::vector<Real> area(pieces.count, 0);
  for (Index f = 0; f < s.mesh.face_count(); ++f) area[pieces.patch_of_face[f]] += s.area[f];
  component.swap(pieces.patch_of_face);
  return area;
}

// Boundary loops in order of their smallest edge. A loop turns inside the surface at vertices with several fans.
void find_short_holes(const Work& work, Real hole_length, PatchSurface& s) {
  const MeshView& mesh = s.mesh;
  s.hole.offset.assign(1, 0);
  s.beside_hole.assign(mesh.face_count(), 0);
  const auto boundary = compact(work, mesh.edge_count(), [&](std::size_t e) { return mesh.edge_f1[e] == kNone; });
  std::vector<std::uint8_t> seen(boundary.size(), 0);
  const auto position = [&](Index e) {
    return static_cast<std::size_t>(std::lower_bound(boundary.begin(), boundary.end(), e) - boundary.begin());
  };
  std::vector<Index> loop, component;
  std::vector<Real> component_area;
  for (std::size_t start = 0; start < boundary.size(); ++start) {
    if (seen[start]) continue;
    if (start % 4096 == 0) work.check();
    loop.clear();
    Real length = 0;
    for (Index e = boundary[start]; !seen[position(e)];) {
      seen[position(e)] = 1;
      loop.push_back(e);
      length += s.edge_length(e);
      const Index f = mesh.edge_f0[e];
      Index i = 0;
      while (mesh.face_edge[3 * f + i] != e) ++i;
      const Index next = next_border(
          mesh, 3 * f + i, [&](Index x) { return mesh.edge_f1[x] != kNone; }, [](Index x) { return x; });
      e = mesh.face_edge[next];
    }
    if (length >= hole_length) continue;
    // The outer border of a small piece of surface is no hole: what a hole is cut into is much larger than the hole.
    if (component.empty()) component_area = component_areas(work, s, component);
    if (length * length > component_area[component[mesh.edge_f0[loop[0]]]]) continue;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      s.hole_before.push_back({loop[i], loop[(i + loop.size() - 1) % loop.size()]});
      s.beside_hole[mesh.edge_f0[loop[i]]] = 1;
    }
    s.hole.item.insert(s.hole.item.end(), loop.begin(), loop.end());
    s.hole.offset.push_back(static_cast<Index>(s.hole.item.size()));
  }
  std::sort(s.hole_before.begin(), s.hole_before.end());
}

}  // namespace

Index PatchSurface::before_on_hole(Index e) const {
  const auto it = std::lower_bound(hole_before.begin(), hole_before.end(), std::pair<Index, Index>{e, 0});
  return it != hole_before.end() && it->first == e ? it->second : kNone;
}

PatchSurface make_patch_surface(const Work& work, const RefinedMesh& refined, Vec3View parent_normal, Real mean_edge,
                                Real hole_length, std::span<const std::uint8_t> locked) {
  PatchSurface s;
  s.mesh = refined.mesh.view();
  s.refined = &refined, s.locked = locked;
  s.strengths = &refined.edge_strength;
  s.normal = FaceVectors(parent_normal, refined.parent);
  s.mean_edge = mean_edge;
  const Index faces = s.mesh.face_count();
  s.area.resize(faces);
  for_each(work, Cost::light, faces, [&](std::size_t i) {
    const Index f = static_cast<Index>(i);
    const auto [a, b, c] = s.mesh.face(f);
    const Vec3 p = s.mesh.point(a);
    const Vec3 cross = (s.mesh.point(b) - p).cross(s.mesh.point(c) - p);
    s.area[f] = cross.norm() / 2;
  });
  s.total_area = sum(work, Cost::light, faces, Real{0}, [&](std::size_t f) { return s.area[f]; });
  find_short_holes(work, hole_length, s);
  return s;
}

SmoothNormals smooth_normals(const Work& work, const PatchSurface& s, std::span<const Index> label, int rounds) {
  const std::size_t faces = s.normal.size();
  SmoothNormals normal;
  for (auto& c : normal.coordinate) c.resize(faces);
  for_each(work, Cost::light, faces, [&](std::size_t f) {
    const Vec3 n = s.normal[static_cast<Index>(f)];
    for (int i = 0; i < 3; ++i) normal.coordinate[static_cast<std::size_t>(i)][f] = static_cast<float>(n[i]);
  });
  if (rounds == 0) return normal;
  std::vector<Index> near(3 * faces);  // neighbours of the same label
  for_each(work, Cost::light, faces, [&](std::size_t f) {
    for (int k = 0; k < 3; ++k) {
      const Index g = s.neighbour(static_cast<Index>(f), k);
      near[3 * f + static_cast<std::size_t>(k)] = g != kNone && label[g] == label[f] ? g : kNone;
    }
  });
  std::vector<float> next(faces);
  for (auto& now : normal.coordinate)  // one at a time: less memory
    for (int round = 0; round < rounds; ++round) {
      const float* const c = now.data();
      for_each(work, Cost::light, faces, [&](std::size_t f) {
        Real sum = s.area[f] * c[f], area = s.area[f];
        for (std::size_t k = 3 * f; k < 3 * f + 3; ++k)
          if (const Index g = near[k]; g != kNone) sum += s.area[g] * c[g], area += s.area[g];
        next[f] = area > 0 ? static_cast<float>(sum / area) : 0.0f;
      });
      now.swap(next);
    }
  return normal;
}

}  // namespace intarsia::kernels
