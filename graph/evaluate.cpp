#include "graph/evaluate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace intarsia::graph {
namespace {

TrianglesView triangles_of(const MeshView& mesh) { return {{mesh.x, mesh.y, mesh.z}, mesh.corner}; }
TrianglesView triangles_of(const kernels::Reconstruction& r) { return {r.point, r.corner}; }

struct Reference {
  TrianglesView triangles;
  TriangleTree tree;
  std::vector<Index> label;  // per triangle
};

Rebuilt measured(const Work& work, kernels::Reconstruction surface, const Reference& input, Index patches,
                 const EvaluateOptions& options) {
  Rebuilt r;
  r.made = true;
  r.failed = surface.failed_count();
  if (surface.corner.empty())
    throw Error(ErrorCode::rejected, "nothing can be rebuilt from a layout without curves: it has one patch");
  r.surface = std::move(surface);
  const TrianglesView rebuilt = triangles_of(r.surface);
  const TriangleTree tree(work, rebuilt);
  r.distance = kernels::surface_distance(work, input.triangles, input.tree, rebuilt, tree, options.distance);
  r.patch = kernels::distance_per_label(r.distance, input.label, patches);
  return r;
}

Real area_of(const MeshView& mesh, Index f) {
  const auto [a, b, c] = mesh.face(f);
  return (mesh.point(b) - mesh.point(a)).cross(mesh.point(c) - mesh.point(a)).norm() / 2;
}

// For every face of the input the patch with most of its area, ties to the smaller id. From areas alone, since layouts
// from files do not know where on the input their vertices lie.
std::vector<Index> labels_of_faces(const MeshView& mesh, const RefinedMesh& refined, std::span<const Index> label) {
  struct Part {
    Index parent, label;
    Real area;
  };
  const MeshView fine = refined.mesh;
  std::vector<Part> part(fine.face_count());
  for (Index f = 0; f < fine.face_count(); ++f) part[f] = {refined.parent[f], label[f], area_of(fine, f)};
  std::stable_sort(part.begin(), part.end(), [](const Part& a, const Part& b) {
    return std::pair(a.parent, a.label) < std::pair(b.parent, b.label);
  });
  std::vector<Index> out(mesh.face_count(), kNone);
  for (std::size_t i = 0; i < part.size();) {
    const Index parent = part[i].parent;
    Real best = -1;
    while (i < part.size() && part[i].parent == parent) {
      const Index l = part[i].label;
      Real area = 0;
      for (; i < part.size() && part[i].parent == parent && part[i].label == l; ++i) area += part[i].area;
      if (area > best * (1 + 1e-9)) best = area, out[parent] = l;
    }
  }
  return out;
}

// The smallest value that at least `share` of them do not exceed.
Real quantile(const std::vector<Real>& sorted, Real share) {
  if (sorted.empty()) return 0;
  const std::size_t rank = static_cast<std::size_t>(std::ceil(share * static_cast<Real>(sorted.size())));
  return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

}  // namespace

std::vector<std::pair<std::string, const Rebuilt*>> Evaluation::made() const {
  std::vector<std::pair<std::string, const Rebuilt*>> all = {{"triangulated", &triangulated},
                                                             {"triangulated_area", &triangulated_area},
                                                             {"transfinite", &transfinite},
                                                             {"filled", &filled}};
  std::erase_if(all, [](const auto& r) { return !r.second->made; });
  return all;
}

Compactness compactness_of(const kernels::SampledLayout& sampled, const MeshView& mesh, std::span<const Index> label) {
  const Index patches = sampled.patch_count();
  Compactness c;
  std::vector<Real> area(patches, 0), perimeter(patches, 0), length(sampled.arc.rows(), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    area[label[f]] += area_of(mesh, f);
  }
  for (Index a = 0; a < sampled.arc.rows(); ++a) {
    const auto row = sampled.arc.row(a);
    for (std::size_t i = 1; i < row.size(); ++i)
      length[a] += (sampled.point[row[i]] - sampled.point[row[i - 1]]).norm();
  }
  for (Index p = 0; p < patches; ++p) {
    for (const Index l : sampled.patch_loops.row(p))
      for (const Index h : sampled.loop.row(l)) perimeter[p] += length[h / 2];
    c.patch.push_back(area[p] > 0 ? perimeter[p] * perimeter[p] / (4 * std::numbers::pi * area[p]) : 0);
  }
  std::vector<Real> sorted = c.patch;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size();
  c.median = n == 0 ? 0 : (sorted[(n - 1) / 2] + sorted[n / 2]) / 2;
  c.high = quantile(sorted, 0.9);
  c.most = n == 0 ? 0 : sorted.back();
  return c;
}

Evaluation evaluate(const Work& work, const MeshView& mesh, const RefinedMesh& refined, std::span<const Index> label,
                    const LayoutGraph& graph, const EvaluateOptions& options) {
  Evaluation e;
  e.patches = graph.patch_count();
  const MeshView fine = refined.mesh;
  const kernels::SampledLayout sampled = kernels::sample_layout(work, fine, graph, label, options.sample);
  e.samples = static_cast<Index>(sampled.point.size());
  e.compactness = compactness_of(sampled, fine, label);
  for (Index p = 0; p < e.patches; ++p)
    if (sampled.patch_loops.row(p).size() != 1) ++e.not_discs;

  const Reference input{triangles_of(mesh), TriangleTree(work, triangles_of(mesh)),
                        labels_of_faces(mesh, refined, label)};
  const auto measure = [&](kernels::Reconstruction surface) {
    return measured(work, std::move(surface), input, e.patches, options);
  };
  if (options.make_triangulated_area) {
    LoopsOptions plain = options.triangulated;
    plain.polygon.metric = PolygonMetric::area;
    e.triangulated_area =
        measure(kernels::reconstruct_triangulated(work, sampled, kernels::triangulate_patches(work, sampled, plain)));
  }
  if (!options.make_triangulated && !options.make_transfinite && !options.make_filled) return e;
  const kernels::PatchTriangulations start = kernels::triangulate_patches(work, sampled, options.triangulated);
  if (options.make_triangulated) e.triangulated = measure(kernels::reconstruct_triangulated(work, sampled, start));
  if (options.make_transfinite)
    e.transfinite = measure(kernels::reconstruct_transfinite(work, sampled, start, options.transfinite));
  if (options.make_filled) e.filled = measure(kernels::reconstruct_filled(work, sampled, start, options.filled));
  return e;
}

}  // namespace intarsia::graph
