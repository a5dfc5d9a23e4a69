#include "tools/export/write_quadwild.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tools/export/file_writer.h"

namespace intarsia::tools {
namespace {

struct FeatureEdge {
  Index face = 0;
  int edge = 0;
  bool convex = true;
};

// Faces in the order of layout.ply.
struct LayoutFaces {
  std::vector<Index> order;     // place -> refined face
  std::vector<Index> place_of;  // refined face -> place
};

LayoutFaces layout_faces(const LayoutView& layout) {
  const RefinedMesh& refined = *layout.refined;
  const Index faces = refined.mesh.face_count();
  std::vector<Index> start(std::size_t{layout.soup->face_count()} + 1, 0);
  for (Index f = 0; f < faces; ++f) ++start[layout.face_order[refined.parent[f]] + 1];
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  LayoutFaces out;
  out.order.resize(faces), out.place_of.resize(faces);
  for (Index f = 0; f < faces; ++f) {
    out.place_of[f] = start[layout.face_order[refined.parent[f]]]++;
    out.order[out.place_of[f]] = f;
  }
  return out;
}

bool is_convex(const MeshView& mesh, Index e) {
  if (mesh.is_boundary_edge(e)) return true;
  const auto opposite = [&](Index f) {
    for (const Index v : mesh.face(f))
      if (v != mesh.edge_v0[e] && v != mesh.edge_v1[e]) return mesh.point(v);
    return mesh.point(mesh.edge_v0[e]);
  };
  const auto [i, j, k] = mesh.face(mesh.edge_f0[e]);
  const Vec3 normal = (mesh.point(j) - mesh.point(i)).cross(mesh.point(k) - mesh.point(i));
  return normal.dot(opposite(mesh.edge_f1[e]) - mesh.point(mesh.edge_v0[e])) <= 0;
}

bool is_feature(CurveKind kind) {
  return kind == CurveKind::ridge || kind == CurveKind::valley || kind == CurveKind::sharp || kind == CurveKind::given;
}

std::vector<FeatureEdge> feature_edges(const LayoutView& layout, const LayoutFaces& faces) {
  const LayoutGraph& graph = *layout.graph;
  const MeshView mesh = layout.refined->mesh;
  std::vector<FeatureEdge> out;
  for (Index a = 0; a < graph.arc_count(); ++a) {
    if (!is_feature(graph.kind[a])) continue;
    for (const Index e : graph.arc_edges.row(a)) {
      Index f = mesh.edge_f0[e];
      if (!mesh.is_boundary_edge(e) && faces.place_of[mesh.edge_f1[e]] < faces.place_of[f]) f = mesh.edge_f1[e];
      int edge = 0;
      for (int i = 0; i < 3; ++i)
        if (mesh.face_edge[3 * f + static_cast<Index>(i)] == e) edge = (i + 1) % 3;  // opposite corner i
      const bool convex =
          graph.kind[a] == CurveKind::ridge || (graph.kind[a] != CurveKind::valley && is_convex(mesh, e));
      out.push_back({faces.place_of[f], edge, convex});
    }
  }
  return out;
}

// The angle that the patch takes at a vertex.
Real angle_inside(const LayoutView& layout, Index vertex, Index patch) {
  const MeshView mesh = layout.refined->mesh;
  Real sum = 0;
  for (const Index f : mesh.vertex_faces.row(vertex)) {
    if (layout.labels->patch_of_face[f] != patch) continue;
    const Index c = static_cast<Index>(mesh.corner_of(f, vertex));
    const Vec3 a = mesh.point(mesh.corner[3 * f + (c + 1) % 3]) - mesh.point(vertex);
    const Vec3 b = mesh.point(mesh.corner[3 * f + (c + 2) % 3]) - mesh.point(vertex);
    sum += std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return sum;
}

std::vector<Index> corners_of(const LayoutView& layout, Index patch) {
  const LayoutGraph& graph = *layout.graph;
  std::vector<Index> all, turning;
  for (const Index l : graph.patch_loops.row(patch))
    for (const Index h : graph.loop.row(l)) {
      const Index n = h % 2 ? graph.end[h / 2] : graph.start[h / 2];
      if (graph.artificial[n]) continue;
      const Index v = graph.node[n];
      all.push_back(layout_vertex(layout, v));
      if (std::abs(angle_inside(layout, v, patch) - std::numbers::pi) > std::numbers::pi / 6)
        turning.push_back(all.back());
    }
  return turning.size() < 3 ? all : turning;
}

std::vector<Index> feature_corners(const LayoutView& layout) {
  const LayoutGraph& graph = *layout.graph;
  std::vector<Index> ends(graph.node_count(), 0), out;
  for (Index a = 0; a < graph.arc_count(); ++a)
    if (is_feature(graph.kind[a])) ++ends[graph.start[a]], ++ends[graph.end[a]];
  for (Index n = 0; n < graph.node_count(); ++n)
    if (ends[n] != 0 && ends[n] != 2) out.push_back(layout_vertex(layout, graph.node[n]));
  return out;
}

void write_mesh(const Work& work, const std::filesystem::path& path, const Handover& handover,
                const LayoutFaces& faces) {
  FileWriter out(path);
  for (Index v = 0; v < handover.layout_vertex_count(); ++v) {
    const Vec3 p = handover.point(v);
    out.text("v {} {} {}\n", p.x(), p.y(), p.z());
    if (v % 4096 == 0) work.check();
  }
  for (const Index f : faces.order) {
    const std::size_t c = 3 * std::size_t{f};
    out.text("f {} {} {}\n", handover.corner(c) + 1, handover.corner(c + 1) + 1, handover.corner(c + 2) + 1);
  }
  out.commit();
}

}  // namespace

std::vector<std::string> quadwild_names() {
  return {"quadwild/layout.obj",       "quadwild/layout.sharp", "quadwild/layout.feature",
          "quadwild/layout.c_feature", "quadwild/layout.patch", "quadwild/layout.corners"};
}

void write_quadwild(const Work& work, const Handover& handover,
                    const std::function<std::filesystem::path(const std::string&)>& path_of) {
  const LayoutView& layout = handover.layout;
  const LayoutFaces faces = layout_faces(layout);
  write_mesh(work, path_of("quadwild/layout.obj"), handover, faces);
  const std::vector<FeatureEdge> edges = feature_edges(layout, faces);

  FileWriter sharp(path_of("quadwild/layout.sharp")), feature(path_of("quadwild/layout.feature"));
  sharp.text("{}\n", edges.size()), feature.text("{}\n", edges.size());
  for (const FeatureEdge& e : edges) {
    sharp.text("{},{},{}\n", e.convex ? 1 : 0, e.face, e.edge);
    feature.text("{},{}\n", e.face, e.edge);
  }
  sharp.commit(), feature.commit();

  FileWriter c_feature(path_of("quadwild/layout.c_feature"));
  const std::vector<Index> ends = feature_corners(layout);
  c_feature.text("{}\n", ends.size());
  for (const Index v : ends) c_feature.text("{}\n", v);
  c_feature.commit();

  FileWriter patch(path_of("quadwild/layout.patch"));
  patch.text("{}\n", faces.order.size());
  for (const Index f : faces.order) patch.text("{}\n", layout.labels->patch_of_face[f]);
  patch.commit();

  FileWriter corners(path_of("quadwild/layout.corners"));
  corners.text("{}\n", handover.patch_count());
  for (Index p = 0; p < handover.patch_count(); ++p) {
    const std::vector<Index> row = corners_of(layout, p);
    corners.text("{}{}{}\n", row.size(), row.empty() ? "" : " ", fmt::join(row, " "));
  }
  corners.commit();
}

}  // namespace intarsia::tools
