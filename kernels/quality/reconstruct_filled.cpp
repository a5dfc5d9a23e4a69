#include <algorithm>
#include <cmath>

#include "engine/space/point_triangle.h"
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

// Opposite to the surface, one border step from every inner point of an arc: at corners it has no one tangent plane.
GhostRow ghosts(const SampledLayout& layout, const PatchBorder& border, std::span<const Index> next) {
  GhostRow ghost;
  ghost.point.assign(border.size(), Vec3::Zero());
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
      ghost.point[i] = border.point[i] - (step / length) * inward;
      ghost.has[i] = 1;
    }
  return ghost;
}

// Whether every point is within `reach` of the triangulation of the border.
bool stays_near(const std::vector<Vec3>& shape, std::span<const Vec3> start, const PatchBorder& border,
                const std::vector<std::array<Index, 3>>& triangle, Real reach) {
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if ((shape[i] - start[i]).norm() <= reach) continue;
    const bool near = std::any_of(triangle.begin(), triangle.end(), [&](const auto& t) {
      return (closest_on_triangle(shape[i], border.point[t[0]], border.point[t[1]], border.point[t[2]]) - shape[i])
                 .norm() <= reach;
    });
    if (!near) return false;
  }
  return true;
}

Real diagonal_of(const std::vector<Vec3>& point) {
  Vec3 low = point[0], high = point[0];
  for (const Vec3& p : point) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).norm();
}

PatchMesh fill(const SampledLayout& layout, const PatchBorder& border, const FillOptions& options,
               PolygonScratch& scratch) {
  PatchMesh mesh = triangulate_border(border, options.start, scratch);
  if (mesh.failed) return mesh;
  const std::vector<std::array<Index, 3>> flat = mesh.triangle;
  std::vector<Vec3> point = border.point;
  refine_patch(point, mesh.triangle, {options.step, options.most_inner});
  const std::vector<Index> next = next_positions(border);
  GhostRow ghost;
  if (options.use_normals) {
    ghost = ghosts(layout, border, next);
  } else {
    ghost.point.resize(border.size()), ghost.has.assign(border.size(), 0);
  }
  const auto shapes = solve_thin_plate(point, border.size(), mesh.triangle, next, ghost, {options.rounds});
  const std::span<const Vec3> start(point.data() + border.size(), point.size() - border.size());
  const Real reach = options.guard * diagonal_of(border.point);
  for (auto shape = shapes.rbegin(); shape != shapes.rend(); ++shape) {
    if (!stays_near(*shape, start, border, flat, reach)) continue;
    mesh.inner = *shape;
    return mesh;
  }
  // Without inner points there is nothing to bend; otherwise every solve went astray.
  mesh.failed = !start.empty();
  mesh.triangle = flat;
  return mesh;
}

}  // namespace

Reconstruction reconstruct_filled(const Work& work, const SampledLayout& layout, const FillOptions& options) {
  return rebuild(work, layout, [&](Index, const PatchBorder& border, PolygonScratch& scratch) {
    return fill(layout, border, options, scratch);
  });
}

}  // namespace intarsia::kernels
