#include "graph/guides.h"

#include <algorithm>

#include "engine/parallel/compact.h"
#include "engine/parallel/for_each.h"
#include "kernels/network/lay_curves.h"
#include "kernels/ridges/chain_segments.h"

namespace intarsia::graph {
namespace {

// The borders of the pinned regions, along mesh edges, as curves of their own.
void add_pin_borders(const Work& work, const MeshView& mesh, const std::vector<Index>& pin, CurveNetwork& net) {
  const std::vector<Index> edge = compact(work, mesh.edge_count(), [&](std::size_t e) {
    return mesh.edge_f1[e] != kNone && pin[mesh.edge_f0[e]] != pin[mesh.edge_f1[e]];
  });
  std::vector<Index> a, b;
  for (const Index e : edge) a.push_back(mesh.edge_v0[e]), b.push_back(mesh.edge_v1[e]);
  const Csr chains = kernels::chain_segments(work, mesh.vertex_count(), a, b, {});
  std::vector<Index> row;
  for (Index c = 0; c < chains.rows(); ++c) {
    row.clear();
    for (const Index v : chains.row(c)) {
      row.push_back(static_cast<Index>(net.point.size()));
      net.point.push_back(SurfacePoint::at_vertex(v));
    }
    if (chains.row(c).front() == chains.row(c).back()) row.back() = row.front();
    net.add_curve(row, CurveKind::given);
  }
}

}  // namespace

Guides surface_to_guides(const Work& work, const Surface& surface, const GivenGuides& given) {
  Guides g;
  if (!given.curve.empty()) {
    std::vector<std::vector<Vec3>> unit = given.curve;
    for (auto& polyline : unit)
      for (Vec3& p : polyline) p = surface.box.to_unit(p);
    kernels::LaidCurves laid = kernels::lay_curves(work, surface.mesh, surface.mean_edge, unit);
    g.curves = std::move(laid.net), g.farthest = laid.farthest, g.gaps = laid.gaps;
  }
  if (given.pin.empty()) return g;
  if (given.pin.size() != surface.input_triangles)
    throw Error(ErrorCode::bad_argument, std::to_string(given.pin.size()) + " pins for " +
                                             std::to_string(surface.input_triangles) + " triangles");
  std::vector<int> known(given.pin);
  std::erase_if(known, [](int p) { return p < 0; });
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  g.regions = static_cast<Index>(known.size());
  if (known.empty()) return g;
  g.pin.resize(surface.mesh.face_count());
  for_each(work, Cost::light, g.pin.size(), [&](std::size_t f) {
    const int p = given.pin[surface.order.face[f]];
    g.pin[f] = p < 0 ? kNone : static_cast<Index>(std::lower_bound(known.begin(), known.end(), p) - known.begin());
  });
  add_pin_borders(work, surface.mesh, g.pin, g.curves);
  g.curves.strength.resize(g.curves.point.size(), 0);
  return g;
}

}  // namespace intarsia::graph
