#include "kernels/layout/check_layout.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>

#include "engine/base/error.h"
#include "engine/parallel/reduce.h"
#include "engine/parallel/union_find.h"
#include "engine/space/surface_path.h"
#include "kernels/layout/label_sums.h"
#include "kernels/layout/parent_weights.h"

namespace intarsia::kernels {
namespace {

struct Tally {
  Index count = 0, example = kNone;
};

Tally operator+(const Tally& a, const Tally& b) { return {a.count + b.count, std::min(a.example, b.example)}; }

// How many of the items fail, and the first that does.
template <class Fails>
Tally tally(const Work& work, std::size_t items, const Fails& fails) {
  return sum(work, Cost::light, items, Tally{}, [&](std::size_t i) {
    return fails(static_cast<Index>(i)) ? Tally{1, static_cast<Index>(i)} : Tally{};
  });
}

Real total_area(const Work& work, const MeshView& mesh) {
  return sum(work, Cost::light, mesh.face_count(), Real{0},
             [&](std::size_t f) { return area_normal(mesh, static_cast<Index>(f)).norm() / 2; });
}

Tally disconnected_patches(const Work& work, const MeshView& mesh, std::span<const Index> label, Index patch_count) {
  UnionFind pieces(mesh.face_count());
  for_each(work, Cost::light, mesh.edge_count(), [&](std::size_t e) {
    const Index f = mesh.edge_f0[e], g = mesh.edge_f1[e];
    if (g != kNone && label[f] == label[g]) pieces.unite(f, g);
  });
  const std::vector<Index> count = sum_by_label<Index>(
      work, mesh.face_count(), patch_count, [&](std::size_t f) { return label[f]; },
      [&](std::size_t f) { return pieces.find(static_cast<Index>(f)) == f ? 1u : 0u; });
  return tally(work, patch_count, [&](Index p) { return count[p] != 1; });
}

Tally loose_ends(const Work& work, const MeshView& mesh, const std::vector<std::uint8_t>& on_network) {
  std::vector<std::uint8_t> degree(mesh.vertex_count(), 0);  // stops at 2
  const auto count = [&](Index v) {
    const std::atomic_ref<std::uint8_t> d(degree[v]);
    std::uint8_t seen = d.load(std::memory_order_relaxed);
    while (seen < 2 && !d.compare_exchange_weak(seen, static_cast<std::uint8_t>(seen + 1), std::memory_order_relaxed)) {
    }
  };
  for_each(work, Cost::light, mesh.edge_count(), [&](std::size_t e) {
    if (on_network[e] || mesh.edge_f1[e] == kNone) count(mesh.edge_v0[e]), count(mesh.edge_v1[e]);
  });
  return tally(work, mesh.vertex_count(), [&](Index v) { return degree[v] == 1; });
}

bool is_out_of_parent(const MeshView& original, const RefinedMesh& refined, const MeshView& mesh, Index f) {
  if (is_uncut(original, refined, f)) {
    for (Index v : mesh.face(f))
      if (!(mesh.x[v] == original.x[v] && mesh.y[v] == original.y[v] && mesh.z[v] == original.z[v])) return true;
    return false;
  }
  const auto share = share_of_parent(original, refined, f);
  if (!share || !(*share >= -1e-12)) return true;
  for (Index v : mesh.face(f)) {
    const SurfacePoint& p = refined.origin[v];
    const Real c = p.kind == PointKind::face ? 1 - p.a - p.b : 1 - p.a;
    if (!(std::min({p.a, p.b, c}) >= -1e-9)) return true;
    const Vec3 x = mesh.point(v);
    if (!((x - position(original, p)).norm() <= 1e-9 * (1 + x.norm()))) return true;
  }
  return false;
}

Tally uncovered_parents(const Work& work, const MeshView& original, const RefinedMesh& refined, Real tolerance) {
  const Csr children = children_of_parents(work, original.face_count(), refined);
  return tally(work, original.face_count(), [&](Index parent) {
    Real covered = 0;
    for (Index f : children.row(parent)) covered += share_of_parent(original, refined, f).value_or(0);
    return !(std::abs(covered - 1) <= tolerance);
  });
}

Tally not_finite(const Work& work, const RefinedMesh& refined) {
  const MeshView mesh = refined.mesh.view();
  return tally(work, mesh.vertex_count(), [&](Index v) {
    const SurfacePoint& p = refined.origin[v];
    return !(mesh.point(v).allFinite() && std::isfinite(p.a) && std::isfinite(p.b));
  });
}

std::int64_t euler_of(const Work& work, const MeshView& mesh) {
  const auto used = sum(work, Cost::light, mesh.vertex_count(), std::int64_t{0}, [&](std::size_t v) {
    return std::int64_t{mesh.vertex_faces.row(static_cast<Index>(v)).empty() ? 0 : 1};
  });
  return used - std::int64_t{mesh.edge_count()} + std::int64_t{mesh.face_count()};
}

// Euler characteristic of every patch cut open along its border: inner vertices - inner edges + faces, because the
// border of an open patch has as many vertices as edges.
std::vector<std::int64_t> open_euler(const Work& work, const MeshView& mesh, std::span<const Index> label,
                                     Index patches) {
  const auto one = [](std::size_t) { return std::int64_t{1}; };
  std::vector<std::uint8_t> outer(mesh.vertex_count(), 0);
  for_each(work, Cost::light, mesh.edge_count(), [&](std::size_t e) {
    if (mesh.edge_f1[e] != kNone) return;
    for (const Index v : {mesh.edge_v0[e], mesh.edge_v1[e]})
      std::atomic_ref<std::uint8_t>(outer[v]).store(1, std::memory_order_relaxed);
  });
  const auto inner_patch_of_vertex = [&](std::size_t i) {
    const Index v = static_cast<Index>(i);
    const auto faces = mesh.vertex_faces.row(v);
    if (faces.empty() || outer[v]) return kNone;
    for (Index f : faces)
      if (label[f] != label[faces[0]]) return kNone;
    return label[faces[0]];
  };
  const auto inner_patch_of_edge = [&](std::size_t e) {
    const Index f = mesh.edge_f0[e], g = mesh.edge_f1[e];
    return g != kNone && label[f] == label[g] ? label[f] : kNone;
  };
  auto euler = sum_by_label<std::int64_t>(work, mesh.vertex_count(), patches, inner_patch_of_vertex, one);
  const auto edges = sum_by_label<std::int64_t>(work, mesh.edge_count(), patches, inner_patch_of_edge, one);
  const auto faces = sum_by_label<std::int64_t>(
      work, mesh.face_count(), patches, [&](std::size_t f) { return label[f]; }, one);
  for (Index p = 0; p < patches; ++p) euler[p] += faces[p] - edges[p];
  return euler;
}

bool is_disc(const LayoutGraph& graph, Index patch, std::int64_t euler, Real hole_length) {
  const auto loops = graph.patch_loops.row(patch);
  std::int64_t holes = 0;
  std::vector<Index> nodes;
  for (Index l : loops) {
    Real length = 0;
    bool outside = true;
    for (Index h : graph.loop.row(l)) {
      length += graph.length[h / 2];
      outside = outside && graph.patch_of_half_arc(h ^ 1) == kNone;
      nodes.push_back(h % 2 ? graph.end[h / 2] : graph.start[h / 2]);
    }
    if (outside && length < hole_length) ++holes;
  }
  const std::int64_t n = static_cast<std::int64_t>(loops.size());
  holes = std::min(holes, std::max(n, std::int64_t{1}) - 1);  // a disc keeps its one border, however short
  std::sort(nodes.begin(), nodes.end());
  const bool pinched = std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end();
  return n - holes == 1 && euler + holes == 1 && !pinched;
}

}  // namespace

bool LayoutChecks::is_valid() const {
  return std::all_of(checks.begin(), checks.end(), [](const LayoutCheck& c) { return c.passed() || c.is_warning; });
}

const LayoutCheck& LayoutChecks::operator[](std::string_view name) const {
  for (const LayoutCheck& c : checks)
    if (c.name == name) return c;
  throw Error(ErrorCode::internal, "no layout check is called " + std::string(name));
}

LayoutChecks check_layout(const Work& work, MeshView original, const RefinedMesh& refined, std::span<const Index> label,
                          Index patch_count, const LayoutGraph& graph, const CheckOptions& options) {
  const MeshView mesh = refined.mesh.view();
  if (label.size() != mesh.face_count() || refined.parent.size() != mesh.face_count() ||
      refined.origin.size() != mesh.vertex_count() || refined.on_network.size() != mesh.edge_count())
    throw Error(ErrorCode::internal,
                "check_layout needs labels, parents, origins and flags for the whole refined mesh");
  LayoutChecks out;
  const auto add = [&](const char* name, const char* element, const Tally& t, bool is_warning = false) {
    out.checks.push_back({name, element, t.count, t.example, is_warning});
  };
  const Tally unlabelled = tally(work, mesh.face_count(), [&](Index f) { return label[f] >= patch_count; });
  add("faces_labelled", "face", unlabelled);
  add("patches_connected", "patch", disconnected_patches(work, mesh, label, patch_count));
  add("no_loose_ends", "vertex", loose_ends(work, mesh, refined.on_network));
  const auto is_border = [&](Index e) {
    return mesh.edge_f1[e] == kNone || label[mesh.edge_f0[e]] != label[mesh.edge_f1[e]];
  };
  add("edges_separate", "edge",
      tally(work, mesh.edge_count(), [&](Index e) { return refined.on_network[e] && !is_border(e); }));
  add("borders_on_network", "edge",
      tally(work, mesh.edge_count(), [&](Index e) { return !refined.on_network[e] && is_border(e); }));

  const Real area = total_area(work, original);
  out.area_error = std::abs(total_area(work, mesh) - area) / (area > 0 ? area : 1);
  add("area", "face", out.area_error <= options.area_tolerance ? Tally{} : Tally{1, kNone});
  add("inside_parent", "face",
      tally(work, mesh.face_count(), [&](Index f) { return is_out_of_parent(original, refined, mesh, f); }));
  add("parents_covered", "parent", uncovered_parents(work, original, refined, options.area_tolerance));
  add("finite", "vertex", not_finite(work, refined));

  out.euler = euler_of(work, mesh);
  if (unlabelled.count == 0 && graph.patch_count() == patch_count) {
    const std::vector<std::int64_t> euler = open_euler(work, mesh, label, patch_count);
    std::int64_t total = std::int64_t{graph.node_count()} - std::int64_t{graph.arc_count()};
    for (const std::int64_t e : euler) total += e;
    add("loops_consistent", "patch", total == out.euler ? Tally{} : Tally{1, kNone});
    add("patches_discs", "patch",
        tally(work, patch_count, [&](Index p) { return !is_disc(graph, p, euler[p], options.hole_length); }), true);
  } else {
    add("loops_consistent", "patch", {1, kNone});
    add("patches_discs", "patch", {}, true);
  }
  return out;
}

}  // namespace intarsia::kernels
