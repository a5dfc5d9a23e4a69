// A layout with known truth: the cube [0, 3]^3 moved to (10, 20, 30), a patch on each side, every edge of the cube one
// arc of as many segments as there are cells along it.
#pragma once

#include <array>
#include <fstream>
#include <iterator>
#include <numeric>
#include <sstream>

#include "engine/parallel/connect_mesh.h"
#include "kernels/layout/trace_boundaries.h"
#include "kernels/patches/flood_patches.h"
#include "kernels/surface/normalise_box.h"
#include "tests/support/shapes.h"
#include "tests/tools/program.h"
#include "tools/export/handover.h"

namespace intarsia::test {

struct LabelledCube {
  static inline const Vec3 kCorner = Vec3(10, 20, 30);
  static constexpr Real kSide = 3;

  Soup soup;
  RefinedMesh refined;
  PatchLabels labels;
  LayoutGraph graph;
  CurveNetwork interior;
  std::vector<Index> vertices, faces;
  std::vector<std::array<std::uint8_t, 3>> colour;
  tools::FeatureLines features;
  tools::Handover handover;

  explicit LabelledCube(Index cells = 2) {
    soup = transformed(cube(cells), [](const Vec3& p) -> Vec3 { return kCorner + kSide * p; });
    const Work work;
    const kernels::BoxTransform box = kernels::normalise_box(work, soup);
    Mesh& mesh = refined.mesh;
    for (Index v = 0; v < soup.vertex_count(); ++v) {
      const Vec3 p = box.to_unit(point(soup, v));
      mesh.x.push_back(p.x()), mesh.y.push_back(p.y()), mesh.z.push_back(p.z());
    }
    mesh.corner = soup.corner;
    connect_mesh(work, mesh);
    std::vector<Index> side;
    for (Index f = 0; f < mesh.face_count(); ++f) side.push_back(side_of(f));
    labels = kernels::flood_equal(work, mesh, side);
    for (Index e = 0; e < mesh.edge_count(); ++e) {
      refined.on_network.push_back(side[mesh.edge_f0[e]] != side[mesh.edge_f1[e]] ? 1 : 0);
      refined.edge_kind.push_back(CurveKind::sharp);
    }
    refined.edge_strength.resize(mesh.edge_count());
    refined.parent.resize(mesh.face_count());
    std::iota(refined.parent.begin(), refined.parent.end(), Index{0});
    graph = kernels::trace_boundaries(work, refined, labels.patch_of_face, labels.count);
    vertices.resize(soup.vertex_count()), faces.resize(soup.face_count());
    std::iota(vertices.begin(), vertices.end(), Index{0});
    std::iota(faces.begin(), faces.end(), Index{0});
    for (std::uint8_t p = 0; p < labels.count; ++p) colour.push_back({255, p, static_cast<std::uint8_t>(20 * p)});
    features.kind = {CurveKind::ridge, CurveKind::valley}, features.chosen = {0, 1};
    features.point = {kCorner, kCorner + Vec3(3, 0, 0), kCorner, kCorner + Vec3(0, 1, 0), kCorner + Vec3(0, 3, 0)};
    features.offset = {0, 2, 5};
    features.length = {3, 3}, features.L = {.5, .5}, features.R = {7, -1}, features.T = {9, -1};
    features.curvature = {1, 2, 0, 0, 0}, features.radius = {.1, .2, 0, 0, 0};
    features.network = {kCorner, kCorner + Vec3(3, 0, 0)}, features.network_kind = {CurveKind::sharp};
    LayoutView& view = handover.layout;
    view.soup = &soup, view.vertex_order = vertices, view.face_order = faces;
    view.centre = box.centre, view.diagonal = box.diagonal;
    view.refined = &refined, view.labels = &labels, view.graph = &graph, view.interior = &interior;
    view.mesh = refined.mesh, view.face_patch = labels.patch_of_face, view.patch_colour = colour;
    handover.features = &features, handover.name = "cube.ply";
    tools::complete(work, handover);
  }
  LabelledCube(const LabelledCube&) = delete;
  LabelledCube& operator=(const LabelledCube&) = delete;

  // 0 .. 5: the axis that the face looks along, and the side.
  int side_of(Index f) const {
    const Vec3 a = point(soup, soup.corner[3 * f]), b = point(soup, soup.corner[3 * f + 1]),
               c = point(soup, soup.corner[3 * f + 2]);
    int axis = 0;
    (b - a).cross(c - a).cwiseAbs().maxCoeff(&axis);
    return 2 * axis + (a[axis] > kCorner[axis] + 1 ? 1 : 0);
  }
};

inline std::vector<std::vector<std::string>> words_of(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::vector<std::string>> lines;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    lines.emplace_back(std::istream_iterator<std::string>(words), std::istream_iterator<std::string>());
  }
  return lines;
}

}  // namespace intarsia::test
