// One walk over the arrays of every data structure: what hashing and size reports are made from.
#pragma once

#include <vector>

#include "graph/artefacts.h"

namespace intarsia::graph {

// visit(array) for each std::vector of scalars; scalar(value) for single values.
template <class V>
void walk(const Vec3Array& a, V& v) {
  v.array(a.x), v.array(a.y), v.array(a.z);
}

template <class V>
void walk(const Csr& a, V& v) {
  v.array(a.offset), v.array(a.item);
}

template <class V>
void walk(const Mesh& a, V& v) {
  v.array(a.x), v.array(a.y), v.array(a.z), v.array(a.corner);
  v.array(a.edge_v0), v.array(a.edge_v1), v.array(a.edge_f0), v.array(a.edge_f1), v.array(a.face_edge);
  walk(a.vertex_faces, v), walk(a.vertex_vertices, v);
}

template <class V>
void walk(const std::vector<SurfacePoint>& a, V& v) {
  v.points(a);
}

template <class V>
void walk(const CurveNetwork& a, V& v) {
  walk(a.point, v), walk(a.curve, v), v.array(a.kind), v.array(a.strength);
}

template <class V>
void walk(const FeatureCurves& a, V& v) {
  walk(a.net, v), walk(a.normal, v), walk(a.across, v);
  for (const auto* f : {&a.kd, &a.kmax, &a.kmin, &a.extremality, &a.sharpness, &a.radius, &a.length, &a.rms_curvature,
                        &a.strength, &a.saliency, &a.component_saliency})
    v.array(*f);
  v.array(a.concave), v.array(a.component), v.array(a.component_passed);
}

template <class V>
void walk(const CurvatureFields& a, V& v) {
  walk(a.normal, v), walk(a.tmax, v), walk(a.tmin, v);
  for (const auto* f : {&a.kmax, &a.kmin, &a.emax, &a.emin, &a.radius}) v.array(*f);
  v.array(a.ring), v.array(a.status), v.array(a.direction_ok);
}

template <class V>
void walk(const RefinedMesh& a, V& v) {
  walk(a.mesh, v), v.array(a.parent), v.scalar(a.origin.originals()), walk(a.origin.added(), v);
  v.array(a.on_network), v.array(a.edge_kind), v.array(a.edge_strength.edges()), v.array(a.edge_strength.values());
}

template <class V>
void walk(const PatchLabels& a, V& v) {
  v.array(a.patch_of_face), v.scalar(a.count);
}

template <class V>
void walk(const LayoutGraph& a, V& v) {
  v.array(a.node), v.array(a.artificial), walk(a.arc, v), walk(a.arc_edges, v), v.array(a.start), v.array(a.end);
  v.array(a.kind), v.array(a.strength), v.array(a.left), v.array(a.right), v.array(a.length);
  walk(a.loop, v), v.array(a.loop_patch), walk(a.patch_loops, v);
}

template <class V>
void walk(const Surface& a, V& v) {
  walk(a.mesh, v), v.array(a.order.vertex), v.array(a.order.face), walk(a.face_normal, v);
  v.scalar(a.area), v.scalar(a.mean_edge), v.scalar(a.rough), walk(a.given, v);
  for (const auto* m : {&a.mended.copy, &a.mended.twin, &a.mended.twin_of, &a.mended.welded, &a.mended.welded_into})
    v.array(*m);
}

template <class V>
void walk(const Scale& a, V& v) {
  for (const auto& o : a.fields.omega) v.array(o);
  v.array(a.fields.scale), v.array(a.fields.fit_ring);
}

template <class V>
void walk(const Sharp& a, V& v) {
  walk(a.edges.curves, v), v.array(a.edges.edge), v.array(a.edges.near_convex), v.array(a.edges.near_concave);
}

template <class V>
void walk(const Curvature& a, V& v) {
  walk(a.fields, v);
}
template <class V>
void walk(const Directions& a, V& v) {
  walk(a.field.direction, v), walk(a.normal, v);
  v.array(a.field.confidence), v.array(a.field.ridge), v.array(a.field.valley);
}
template <class V>
void walk(const Lines& a, V& v) {
  for (const auto* lines : {&a.lines.tmax, &a.lines.tmin})
    for (const auto& coordinate : *lines) v.array(coordinate);
  v.array(a.lines.confidence);
}
template <class V>
void walk(const Ridges& a, V& v) {
  walk(a.curves, v);
}
template <class V>
void walk(const Curves& a, V& v) {
  walk(a.curves, v);
}

template <class V>
void walk(const Guides& a, V& v) {
  walk(a.curves, v), v.array(a.pin);
}
template <class V>
void walk(const Goal& a, V& v) {
  v.scalar(a.patches), v.scalar(a.rms);
}

template <class V>
void walk(const Network& a, V& v) {
  walk(a.refined, v), walk(a.features, v), v.array(a.feature_concave), v.array(a.feature_edge),
      v.scalar(a.min_saliency), v.scalar(a.patches), v.array(a.locked);
}

template <class V>
void walk(const Patches& a, V& v) {
  walk(a.labels, v), v.array(a.on_network), v.array(a.edge_kind);
}

template <class V>
void walk(const kernels::SmoothedArcs& a, V& v) {
  walk(a.node, v), v.array(a.node_fixed), v.array(a.offset), walk(a.point, v), v.array(a.fixed);
}

template <class V>
void walk(const Smoothing& a, V& v) {
  walk(a.graph, v), walk(a.arcs, v), walk(a.gentle, v);
  v.array(a.shares.whole), v.array(a.shares.face), v.array(a.shares.offset);
  v.array(a.shares.label), v.array(a.shares.share), v.array(a.error), walk(a.interior, v);
  walk(a.refined, v), walk(a.network, v);
}

template <class V>
void walk(const Layout& a, V& v) {
  walk(a.refined, v), walk(a.labels, v), walk(a.graph, v), v.array(a.face_patch);
  walk(a.interior, v);
}

}  // namespace intarsia::graph
