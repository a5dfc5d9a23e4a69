// Labelled meshes for the layout kernels: a mesh as its own refinement, with the borders between labels as network.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/data/fields.h"
#include "engine/data/layout_graph.h"
#include "engine/parallel/connect_mesh.h"
#include "kernels/layout/check_layout.h"
#include "kernels/layout/cross_edges.h"
#include "kernels/layout/match_labels.h"
#include "kernels/layout/smooth_boundaries.h"
#include "engine/space/surface_path.h"
#include "kernels/layout/trace_boundaries.h"
#include "kernels/network/embed_curves.h"
#include "kernels/patches/flood_patches.h"
#include "tests/support/shapes.h"

namespace intarsia::test {

inline Mesh connected(const Soup& soup) {
  Mesh m;
  m.x = soup.x, m.y = soup.y, m.z = soup.z, m.corner = soup.corner;
  connect_mesh(Work(), m);
  return m;
}

inline Vec3 centroid(const MeshView& mesh, Index f) {
  const auto [a, b, c] = mesh.face(f);
  return (mesh.point(a) + mesh.point(b) + mesh.point(c)) / 3;
}

struct LayoutCase {
  Mesh mesh;  // the original
  RefinedMesh refined;
  std::vector<Index> label;
  Index count = 0;
};

// kind(e) for edges between two labels; the mesh boundary is always border.
template <class Label, class Kind>
LayoutCase identity_case(const Soup& soup, const Label& label, const Kind& kind) {
  LayoutCase c;
  c.mesh = connected(soup);
  const MeshView m = c.mesh;
  std::vector<Index> id(m.face_count());
  for (Index f = 0; f < m.face_count(); ++f) id[f] = label(m, f);
  const PatchLabels labels = kernels::flood_equal(Work(), m, id);
  c.label = labels.patch_of_face, c.count = labels.count;
  c.refined.mesh = c.mesh;
  c.refined.parent.resize(m.face_count());
  for (Index f = 0; f < m.face_count(); ++f) c.refined.parent[f] = f;
  for (Index v = 0; v < m.vertex_count(); ++v) c.refined.origin.push_back(SurfacePoint::at_vertex(v));
  c.refined.on_network.assign(m.edge_count(), 0);
  c.refined.edge_kind.assign(m.edge_count(), CurveKind::border);
  c.refined.edge_strength.resize(m.edge_count());
  for (Index e = 0; e < m.edge_count(); ++e) {
    if (m.is_boundary_edge(e)) {
      c.refined.on_network[e] = 1;
    } else if (c.label[m.edge_f0[e]] != c.label[m.edge_f1[e]]) {
      c.refined.on_network[e] = 1;
      c.refined.edge_kind[e] = kind(m, e);
    }
  }
  return c;
}

template <class Label>
LayoutCase identity_case(const Soup& soup, const Label& label, CurveKind kind) {
  return identity_case(soup, label, [&](const MeshView&, Index) { return kind; });
}

// Label = nearest of `seeds` pseudo-random faces.
struct Nearest {
  Index seeds;
  std::uint64_t seed = 1;
  Index operator()(const MeshView& m, Index f) const {
    const Random random(seed, 3);
    Index best = 0;
    Real least = 1e300;
    for (Index s = 0; s < seeds; ++s) {
      const Real d = (centroid(m, f) - centroid(m, static_cast<Index>(random.bits(s) % m.face_count()))).norm();
      if (d < least) least = d, best = s;
    }
    return best;
  }
};

// Closed tube around the z axis with flat caps; caps first to last: bottom, top.
inline Soup capped_cylinder(Real radius, Real height, Index around, Index along) {
  Soup s = cylinder(radius, radius, height, around, along);
  const Index bottom = add_vertex(s, Vec3(0, 0, 0)), top = add_vertex(s, Vec3(0, 0, height));
  for (Index i = 0; i < around; ++i) {
    const Index j = (i + 1) % around;
    add_face(s, bottom, j, i);
    add_face(s, top, along * around + i, along * around + j);
  }
  return s;
}

inline LayoutGraph trace(const LayoutCase& c) { return kernels::trace_boundaries(Work(), c.refined, c.label, c.count); }

inline Real length_of(const MeshView& mesh, const CurveNetwork& net, Index c) {
  Real length = 0;
  const auto row = net.curve.row(c);
  for (std::size_t i = 1; i < row.size(); ++i)
    length += (position(mesh, net.point[row[i]]) - position(mesh, net.point[row[i - 1]])).norm();
  return length;
}

// The whole way: trace, smooth, cross, embed, flood, match; arcs of patches in trouble go back to their chains.
struct Relayout {
  LayoutCase fresh;
  LayoutGraph before, after;
  kernels::SmoothedArcs smoothed;
  kernels::CrossedArcs crossed;
  kernels::LabelMatch match;
  kernels::LayoutChecks checks;
  int rounds = 0;
};

inline Relayout relayout(const LayoutCase& c, const kernels::PrincipalLines& lines = {},
                         const kernels::SmoothOptions& options = {}) {
  const Work work;
  Relayout r;
  r.before = trace(c);
  r.smoothed = kernels::smooth_boundaries(work, c.mesh, c.refined, r.before, c.label, lines, options);
  std::vector<std::uint8_t> keep(r.before.arc_count(), 0);
  for (r.rounds = 1; r.rounds <= 4; ++r.rounds) {
    r.crossed = kernels::cross_edges(work, c.mesh, c.refined, r.before, r.smoothed, keep);
    kernels::Embedding e = kernels::embed_curves(work, c.mesh, r.crossed.network);
    const PatchLabels found = kernels::flood_patches(work, e.refined.mesh, e.refined.on_network);
    r.match =
        kernels::match_labels(work, c.mesh, c.refined, c.label, c.count, e.refined, found.patch_of_face, found.count);
    std::vector<Index> trouble = r.match.trouble;
    if (r.match.ok) {
      r.fresh.label.clear();
      for (Index l : found.patch_of_face) r.fresh.label.push_back(r.match.old_of_new[l]);
      trouble = kernels::patches_out_of_place(work, r.before, e.refined.mesh, r.fresh.label, e.edge, e.edge_curve);
    }
    if (r.match.ok && trouble.empty()) {
      r.fresh.mesh = c.mesh, r.fresh.refined = std::move(e.refined), r.fresh.count = c.count;
      r.after = trace(r.fresh);
      r.checks = kernels::check_layout(work, c.mesh, r.fresh.refined, r.fresh.label, r.fresh.count, r.after);
      return r;
    }
    const auto bad = kernels::arcs_of_patches(r.before, trouble);
    for (std::size_t a = 0; a < keep.size(); ++a) keep[a] = r.rounds >= 3 ? 1 : keep[a] | bad[a];
  }
  r.match.ok = false;
  return r;
}

}  // namespace intarsia::test
