#include "kernels/quality/patch_border.h"
#include "kernels/quality/refine_patch.h"
#include "kernels/quality/thin_plate.h"

namespace intarsia::kernels {
namespace {

std::vector<Index> next_positions(const PatchBorder& border) {
  std::vector<Index> next(border.size());
  for (Index l = 0; l < border.loops(); ++l)
    for (Index i = border.offset[l]; i < border.offset[l + 1]; ++i)
      next[i] = i + 1 == border.offset[l + 1] ? border.offset[l] : i + 1;
  return next;
}

// At every inner point of an arc; at corners the surface has no one tangent plane.
GhostRow ghosts(const SampledLayout& layout, const PatchBorder& border, std::span<const Index> next) {
  GhostRow ghost;
  ghost.outward.assign(border.size(), Vec3::Zero());
  ghost.has.assign(border.size(), 0);
  std::vector<Index> last(border.size());
  for (Index i = 0; i < border.size(); ++i) last[next[i]] = i;
  for (std::size_t s = 0; s + 1 < border.side.size(); ++s)
    for (Index i = border.side[s] + 1; i < border.side[s + 1]; ++i) {
      const Vec3 normal = layout.normal[border.half_arc[s] % 2][border.id[i]];
      const Vec3 before = border.point[last[i]], after = border.point[next[i]];
      const Vec3 inward = normal.cross(after - before);  // the patch is on the left
      const Real length = inward.norm();
      const Real step = ((after - border.point[i]).norm() + (border.point[i] - before).norm()) / 2;
      if (!(length > 1e-9 * step)) continue;
      ghost.outward[i] = -(step / length) * inward;
      ghost.has[i] = 1;
    }
  return ghost;
}

PatchMesh fill(const SampledLayout& layout, const PatchBorder& border, const Triangles& flat,
               const FillOptions& options) {
  PatchMesh mesh{{}, flat};
  std::vector<Vec3> point = border.point;
  refine_patch(point, mesh.triangle, {options.step, options.most_inner});
  const std::span<const Vec3> start(point.data() + border.size(), point.size() - border.size());
  const std::vector<Index> next = next_positions(border);
  GhostRow ghost;
  if (options.use_normals) {
    ghost = ghosts(layout, border, next);
  } else {
    ghost.outward.assign(border.size(), Vec3::Zero()), ghost.has.assign(border.size(), 0);
  }
  const auto shapes =
      solve_thin_plate(point, border.size(), mesh.triangle, next, ghost, {options.flat_rounds, options.bent_rounds});
  const Real reach = options.guard * diagonal_of(border.point);
  for (auto shape = shapes.rbegin(); shape != shapes.rend(); ++shape) {
    if (!stays_near(*shape, start, border.point, flat, reach)) continue;
    mesh.inner = *shape;
    return mesh;
  }
  // Without inner points there is nothing to bend; otherwise every solve went astray.
  return {{}, flat, !start.empty(), false};
}

}  // namespace

Reconstruction reconstruct_filled(const Work& work, const SampledLayout& layout,
                                  const PatchTriangulations& triangulated, const FillOptions& options) {
  return rebuild(work, layout, [&](Index p, const PatchBorder& border) {
    if (triangulated.triangle[p].empty()) return PatchMesh{};
    return fill(layout, border, triangulated.triangle[p], options);
  });
}

}  // namespace intarsia::kernels
