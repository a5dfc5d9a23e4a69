// A mesh as its own refinement, with a network given by a predicate on edges.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/data/curve_network.h"
#include "engine/parallel/connect_mesh.h"
#include "tests/support/shapes.h"

namespace intarsia::test {

struct TestRefinement {
  RefinedMesh refined;
  Vec3Array normal;  // per face, unit or zero
  Real mean_edge = 0;
};

// on_network(mesh, edge) is asked for interior edges; boundary edges are always on the network.
template <class OnNetwork>
TestRefinement identity_refinement(Mesh mesh, const OnNetwork& on_network) {
  TestRefinement t;
  t.refined.mesh = std::move(mesh);
  RefinedMesh& r = t.refined;
  const MeshView m = r.mesh.view();
  t.normal.resize(m.face_count());
  for (Index f = 0; f < m.face_count(); ++f) {
    r.parent.push_back(f);
    const auto [a, b, c] = m.face(f);
    const Vec3 n = (m.point(b) - m.point(a)).cross(m.point(c) - m.point(a));
    t.normal.set(f, n.norm() > 0 ? Vec3(n / n.norm()) : Vec3::Zero());
  }
  for (Index v = 0; v < m.vertex_count(); ++v) r.origin.push_back(SurfacePoint::at_vertex(v));
  for (Index e = 0; e < m.edge_count(); ++e) {
    t.mean_edge += (m.point(m.edge_v0[e]) - m.point(m.edge_v1[e])).norm() / m.edge_count();
    const bool boundary = m.edge_f1[e] == kNone, network = boundary || on_network(m, e);
    r.on_network.push_back(network ? 1 : 0);
    r.edge_kind.push_back(boundary ? CurveKind::border : CurveKind::sharp);
    const Real dot = boundary ? 1 : t.normal[m.edge_f0[e]].dot(t.normal[m.edge_f1[e]]);
    r.edge_strength.push_back(network && !boundary ? std::acos(std::clamp(dot, Real{-1}, Real{1})) : 0);
  }
  return t;
}

template <class OnNetwork>
TestRefinement identity_refinement(const Soup& soup, const OnNetwork& on_network) {
  Mesh mesh;
  mesh.x = soup.x, mesh.y = soup.y, mesh.z = soup.z, mesh.corner = soup.corner;
  connect_mesh(Work(), mesh);
  return identity_refinement(std::move(mesh), on_network);
}

inline Real turn(const MeshView& m, Index e) {
  const auto normal = [&](Index f) {
    const auto [a, b, c] = m.face(f);
    return (m.point(b) - m.point(a)).cross(m.point(c) - m.point(a)).normalized();
  };
  return std::acos(std::clamp(normal(m.edge_f0[e]).dot(normal(m.edge_f1[e])), Real{-1}, Real{1}));
}

// The network of all edges that turn by more than `angle` (radians).
template <class Surface>
TestRefinement sharp_refinement(const Surface& surface, Real angle) {
  return identity_refinement(surface, [&](const MeshView& m, Index e) { return turn(m, e) > angle; });
}

}  // namespace intarsia::test
