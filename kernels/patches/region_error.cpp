#include "kernels/patches/region_error.h"

#include <algorithm>
#include <utility>

namespace intarsia::kernels {
namespace {

// What lies across a border edge: tells where one neighbour ends and the next begins.
std::pair<Index, Index> across(const PatchSurface& s, const Regions& regions, Index corner) {
  const Index f = corner / 3, g = s.mesh.other_face(s.mesh.face_edge[corner], f);
  return g == kNone ? std::pair{kNone, kNone} : std::pair{regions.source[g], regions.label[g]};
}

bool is_fixed(const PatchSurface& s, Index corner) {
  const Index e = s.mesh.face_edge[corner];
  return s.strength(e) > 0 || s.mesh.is_boundary_edge(e);
}

Index start_of(const PatchSurface& s, Index corner) { return s.mesh.corner[3 * (corner / 3) + (corner % 3 + 1) % 3]; }
Index end_of(const PatchSurface& s, Index corner) { return s.mesh.corner[3 * (corner / 3) + (corner % 3 + 2) % 3]; }

// Between two half-edges that follow each other: another neighbour, or a feature or boundary that turns by more than 60
// degrees. Free borders zigzag along mesh edges and have no corners of their own.
bool is_corner(const PatchSurface& s, const Regions& regions, Index here, Index next) {
  if (across(s, regions, here) != across(s, regions, next)) return true;
  if (!is_fixed(s, here) || !is_fixed(s, next)) return is_fixed(s, here) != is_fixed(s, next);
  const Vec3 middle = s.mesh.point(end_of(s, here));
  const Vec3 a = middle - s.mesh.point(start_of(s, here)), b = s.mesh.point(end_of(s, next)) - middle;
  return a.dot(b) < 0.5 * a.norm() * b.norm();
}

void add_loop(const PatchSurface& s, const Regions& regions, std::span<const Index> loop, int smoothing,
              Outline& outline) {
  const std::size_t n = loop.size();
  std::size_t from = 0;
  for (std::size_t k = 0; k < n; ++k)
    if (is_corner(s, regions, loop[(k + n - 1) % n], loop[k])) {
      from = k;
      break;
    }
  for (std::size_t k = 0; k < n; ++k) {
    const Index here = loop[(from + k) % n], next = loop[(from + k + 1) % n];
    outline.point.push_back(s.mesh.point(start_of(s, here)));
    if (k + 1 < n && !is_corner(s, regions, here, next)) continue;
    outline.point.push_back(s.mesh.point(end_of(s, here)));
    if (!is_fixed(s, here)) smooth_polyline(std::span(outline.point).subspan(outline.piece.back()), smoothing);
    outline.end_piece();
  }
  outline.end_loop();
}

void sample_faces(const PatchSurface& s, std::span<const Index> faces, Index wanted, WeightedPoints& samples) {
  samples.clear();
  Real total = 0;
  for (const Index f : faces) total += s.area[f];
  const std::size_t count = std::min<std::size_t>(faces.size(), wanted);
  if (count == 0) return;
  const Real share = total / static_cast<Real>(count);
  Real sum = 0;
  for (const Index f : faces) {
    const Real middle = (static_cast<Real>(samples.point.size()) + 0.5) * share;
    if (sum <= middle && middle < sum + s.area[f] && samples.point.size() < count) samples.add(s.centroid(f), 0);
    sum += s.area[f];
  }
  for (Real& w : samples.weight) w = total / static_cast<Real>(samples.weight.size());
}

}  // namespace

void region_outline(const PatchSurface& s, const Region& region, const Regions& regions, int smoothing,
                    RegionErrorScratch& scratch) {
  const MeshView& mesh = s.mesh;
  scratch.outline.clear();
  scratch.border.clear();
  const auto inside = [&](Index f) { return f != kNone && regions.is_in(f, region.source, region.label); };
  for (const Index f : region.faces)
    for (Index i = 0; i < 3; ++i)
      if (!inside(s.neighbour(f, static_cast<int>(i)))) scratch.border.push_back(3 * f + i);
  scratch.seen.assign(scratch.border.size(), 0);
  const auto position = [&](Index c) {
    return static_cast<std::size_t>(std::lower_bound(scratch.border.begin(), scratch.border.end(), c) -
                                    scratch.border.begin());
  };
  const auto crossing = [&](Index e) { return inside(mesh.edge_f0[e]) && inside(mesh.edge_f1[e]); };
  std::vector<Index> loop;
  for (std::size_t start = 0; start < scratch.border.size(); ++start) {
    if (scratch.seen[start]) continue;
    loop.clear();
    bool hole = true;
    for (Index c = scratch.border[start];;) {
      const std::size_t at = position(c);
      if (at == scratch.border.size() || scratch.border[at] != c || scratch.seen[at]) break;
      scratch.seen[at] = 1;
      loop.push_back(c);
      hole = hole && s.before_on_hole(mesh.face_edge[c]) != kNone;
      c = next_border(mesh, c, crossing, [](Index x) { return x; });
    }
    if (!hole) add_loop(s, regions, loop, smoothing, scratch.outline);
  }
}

Real region_error(const PatchSurface& s, const Region& region, const Regions& regions,
                  const RegionErrorOptions& options, RegionErrorScratch& scratch) {
  region_outline(s, region, regions, options.smoothing, scratch);
  sample_faces(s, region.faces, options.samples, scratch.samples);
  return outline_error(scratch.outline, scratch.samples, options.outline, scratch.error);
}

}  // namespace intarsia::kernels
