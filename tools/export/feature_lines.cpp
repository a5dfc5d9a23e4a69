#include "tools/export/feature_lines.h"

#include "kernels/curves/measure_curves.h"

namespace intarsia::tools {
namespace {

void add_raw(const Work& work, const graph::Surface& surface, FeatureCurves curves, FeatureLines& lines) {
  kernels::measure_curves(work, surface.mesh, {}, curves);
  const MeshView mesh = surface.mesh;
  const Real diagonal = surface.box.diagonal;
  for (Index c = 0; c < curves.curve_count(); ++c) {
    for (const Index p : curves.points_of(c)) {
      lines.point.push_back(surface.box.to_input(position(mesh, curves.net.point[p])));
      lines.curvature.push_back(curves.kd[p] / diagonal), lines.radius.push_back(curves.radius[p] * diagonal);
    }
    lines.offset.push_back(lines.point.size());
    lines.kind.push_back(curves.net.kind[c]), lines.chosen.push_back(0);
    lines.length.push_back(curves.length[c] * diagonal), lines.L.push_back(curves.length[c]);
    lines.R.push_back(curves.rms_curvature[c]), lines.T.push_back(curves.strength[c]);
    if (c % 1024 == 0) work.check();
  }
}

void add_chosen(const graph::Surface& surface, const CurveNetwork& net, FeatureLines& lines) {
  const MeshView mesh = surface.mesh;
  for (Index c = 0; c < net.curve_count(); ++c) {
    Real length = 0;
    Vec3 last = Vec3::Zero();
    for (const Index p : net.curve.row(c)) {
      const Vec3 place = surface.box.to_input(position(mesh, net.point[p]));
      if (p != net.curve.row(c).front() || lines.point.size() > lines.offset.back()) length += (place - last).norm();
      lines.point.push_back(last = place);
      lines.curvature.push_back(0), lines.radius.push_back(0);
    }
    lines.offset.push_back(lines.point.size());
    lines.kind.push_back(net.kind[c]), lines.chosen.push_back(1);
    lines.length.push_back(length), lines.L.push_back(length / surface.box.diagonal);
    lines.R.push_back(-1), lines.T.push_back(-1);
  }
}

}  // namespace

FeatureLines feature_lines(const Work& work, const graph::Surface& surface, const graph::Ridges& ridges,
                           const graph::Ridges& valleys, const graph::Sharp& sharp, const graph::Network& network) {
  FeatureLines lines;
  for (const FeatureCurves* raw : {&ridges.curves, &valleys.curves, &sharp.edges.curves})
    add_raw(work, surface, *raw, lines);
  add_chosen(surface, network.features, lines);
  const RefinedMesh& refined = network.refined;
  const MeshView mesh = refined.mesh;
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    if (!refined.on_network[e]) continue;
    for (const Index v : {mesh.edge_v0[e], mesh.edge_v1[e]})
      lines.network.push_back(surface.box.to_input(mesh.point(v)));
    lines.network_kind.push_back(refined.edge_kind[e]);
  }
  return lines;
}

}  // namespace intarsia::tools
