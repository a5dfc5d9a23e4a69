#include "kernels/cells/cell_complex.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/for_each.h"
#include "kernels/cells/inward_directions.h"

namespace intarsia::kernels {
namespace {

bool is_free(CurveKind kind) { return kind == CurveKind::extension || kind == CurveKind::subdivision; }

void add_arcs(const Work& work, const RefinedMesh& refined, const LayoutGraph& g, int smoothing, CellComplex& c) {
  const MeshView mesh = refined.mesh;
  const Index arcs = g.arc_count();
  c.start = g.start, c.end = g.end, c.nodes = g.node_count();
  c.length.resize(arcs), c.salience.assign(arcs, 0), c.given.assign(arcs, 0);
  c.arc_offset = g.arc.offset;
  if (c.arc_offset.empty()) c.arc_offset.push_back(0);
  c.point.resize(g.arc.item.size());
  for (auto& i : c.inward) i.assign(c.point.size(), Vec3::Zero());
  for_each(work, Cost::heavy, arcs, [&](std::size_t i) {
    const Index a = static_cast<Index>(i);
    const auto row = g.arc.row(a);
    const std::span<Vec3> p = std::span(c.point).subspan(c.arc_offset[a], row.size());
    for (std::size_t k = 0; k < row.size(); ++k) p[k] = mesh.point(row[k]);
    for (const Index e : g.arc_edges.row(a)) {
      const Real theta = refined.edge_strength.empty() ? 0 : refined.edge_strength[e];
      c.given[a] |= refined.is_given(e) ? 1 : 0;
      c.salience[a] += theta * theta * (mesh.point(mesh.edge_v1[e]) - mesh.point(mesh.edge_v0[e])).norm();
    }
    if (is_free(g.kind[a])) smooth_polyline(p, smoothing);
    Real length = 0;
    for (std::size_t k = 1; k < p.size(); ++k) length += (p[k] - p[k - 1]).norm();
    c.length[a] = length;
    for (const int side : {0, 1})
      inward_directions(mesh, row, p, side == 0, std::span(c.inward[side]).subspan(c.arc_offset[a], row.size()));
  });
}

void add_links(const LayoutGraph& g, Index cells, CellComplex& c) {
  c.next.assign(std::size_t{2} * g.arc_count(), kNone);
  c.half_cell.resize(c.next.size());
  for (Index h = 0; h < c.next.size(); ++h) c.half_cell[h] = g.patch_of_half_arc(h);
  for (Index l = 0; l < g.loop_count(); ++l) {
    const auto row = g.loop.row(l);
    for (std::size_t k = 0; k < row.size(); ++k) c.next[row[k]] = row[(k + 1) % row.size()];
  }
  std::vector<Index> degree(c.nodes, 0);
  for (Index a = 0; a < g.arc_count(); ++a) ++degree[g.start[a]], ++degree[g.end[a]];
  c.corner.resize(c.nodes);
  for (Index n = 0; n < c.nodes; ++n) c.corner[n] = degree[n] == 2 && !g.artificial[n] ? 1 : 0;
  c.cell_halves.offset.assign(1, 0);
  for (Index cell = 0; cell < cells; ++cell) {
    for (const Index l : g.patch_loops.row(cell))
      for (const Index h : g.loop.row(l)) c.cell_halves.item.push_back(h);
    c.cell_halves.offset.push_back(static_cast<Index>(c.cell_halves.item.size()));
  }
}

// Even shares of the faces of each cell in their order, each at its area-weighted middle face.
void add_samples(const Work& work, const RefinedMesh& refined, const PatchLabels& labels, Real total,
                 const CellOptions& options, CellComplex& c) {
  const MeshView mesh = refined.mesh;
  const Csr faces = faces_of_patches(labels);
  const Index cells = labels.count;
  std::vector<std::vector<std::pair<Vec3, Real>>> found(cells);
  for_each(work, Cost::single, cells, [&](std::size_t i) {
    const Index cell = static_cast<Index>(i);
    const auto row = faces.row(cell);
    const Real wanted = total > 0 ? std::ceil(options.samples * c.area[cell] / total) : 0;
    const std::size_t count = std::min<std::size_t>(
        row.size(), std::max<std::size_t>(options.least_samples, static_cast<std::size_t>(wanted)));
    const Real share = count > 0 ? c.area[cell] / static_cast<Real>(count) : 0;
    Real sum = 0;
    for (const Index f : row) {
      const auto [a, b, d] = mesh.face(f);
      const Vec3 p = mesh.point(a);
      const Real area = (mesh.point(b) - p).cross(mesh.point(d) - p).norm() / 2;
      const Real middle = (static_cast<Real>(found[cell].size()) + 0.5) * share;
      if (sum <= middle && middle < sum + area && found[cell].size() < count)
        found[cell].push_back({(p + mesh.point(b) + mesh.point(d)) / 3, share});
      sum += area;
    }
    // Large faces hold several middles: what is missing is made up for by weight.
    for (auto& s : found[cell]) s.second = c.area[cell] / static_cast<Real>(found[cell].size());
  });
  c.samples.offset.assign(1, 0);
  for (const auto& f : found) {
    for (const auto& [p, w] : f) {
      c.samples.item.push_back(static_cast<Index>(c.sample.size()));
      c.sample.push_back(p), c.weight.push_back(w);
    }
    c.samples.offset.push_back(static_cast<Index>(c.samples.item.size()));
  }
}

}  // namespace

CellComplex make_cell_complex(const Work& work, const RefinedMesh& refined, const PatchLabels& labels,
                              const PatchTable& table, const LayoutGraph& graph, Real hole_length,
                              const CellOptions& options) {
  CellComplex c;
  c.hole_length = hole_length;
  c.area = table.area;
  Real total = 0;
  for (const Real a : c.area) total += a;
  add_arcs(work, refined, graph, options.smoothing, c);
  add_links(graph, labels.count, c);
  // Without its border the Euler characteristic stays: circles have none. A cell that touches itself has a smaller one.
  for (Index p = 0; p < labels.count; ++p)
    c.open_euler.push_back(table.euler[p] - static_cast<int>(table.filled_holes[p]));
  add_samples(work, refined, labels, total, options, c);
  return c;
}

}  // namespace intarsia::kernels
