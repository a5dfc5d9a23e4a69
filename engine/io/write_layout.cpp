#include "engine/io/write_layout.h"

#include <compare>

#include "engine/io/write_ply.h"
#include "engine/parallel/for_each.h"
#include "engine/parallel/scan.h"
#include "engine/parallel/single_precision.h"
#include "engine/parallel/sort.h"

namespace intarsia {
namespace {

template <class Element>
void add_positions(Element& element, bool single, const Soup& soup) {
  if (single)
    element.template xyz<float>(soup.x, soup.y, soup.z);
  else
    element.template xyz<double>(soup.x, soup.y, soup.z);
}

// Where several canonical faces are one soup triangle.
void label_by_area(const Work& work, const LayoutView& layout, std::vector<Index>& patch) {
  struct Share {
    Index triangle, patch, face;
    auto operator<=>(const Share&) const = default;
  };
  std::vector<Share> share(layout.face_order.size());
  for_each(work, Cost::light, share.size(), [&](std::size_t f) {
    share[f] = {layout.face_order[f], layout.face_patch[f], static_cast<Index>(f)};
  });
  sort_total(work, share.begin(), share.end());
  Real best = 0, own = 0;
  for (std::size_t i = 0; i < share.size(); ++i) {
    const Share& s = share[i];
    const bool same_triangle = i > 0 && share[i - 1].triangle == s.triangle;
    if (!same_triangle) best = -1;
    if (!same_triangle || share[i - 1].patch != s.patch) own = 0;
    const auto [a, b, c] = layout.mesh.face(s.face);
    const Vec3 p = layout.mesh.point(a);
    own += (layout.mesh.point(b) - p).cross(layout.mesh.point(c) - p).norm();
    if (own > best) best = own, patch[s.triangle] = s.patch;
  }
}

}  // namespace

std::vector<Index> input_patches(const Work& work, const LayoutView& layout) {
  std::vector<Index> patch(layout.soup->face_count(), kNone);
  if (layout.divided)
    label_by_area(work, layout, patch);
  else
    for_each(work, Cost::light, layout.face_order.size(),
             [&](std::size_t f) { patch[layout.face_order[f]] = layout.face_patch[f]; });
  for (std::size_t i = 0; i < layout.twin.size(); ++i) patch[layout.twin[i]] = patch[layout.twin_of[i]];
  return patch;
}

void write_patches_ply(const Work& work, const std::filesystem::path& path, const LayoutView& layout) {
  const Soup& soup = *layout.soup;
  const std::vector<Index> patch = input_patches(work, layout);
  PlyFile ply;
  ply.comment("intarsia patches: faces in the order of the input, int patch per face");
  auto& vertex = ply.element("vertex", soup.vertex_count());
  add_positions(vertex, is_single_precision(work, soup, soup.vertex_count(), [](std::size_t v) { return v; }), soup);
  auto& face = ply.element("face", soup.face_count());
  face.triangles(soup.corner).column<std::int32_t>("patch", [&](std::size_t f) {
    return patch[f] == kNone ? -1 : static_cast<int>(patch[f]);
  });
  const char* channel[] = {"red", "green", "blue"};
  for (int i = 0; i < 3; ++i)
    face.column<std::uint8_t>(channel[i], [&, i](std::size_t f) {
      return patch[f] == kNone ? std::uint8_t{128} : layout.patch_colour[patch[f]][i];
    });
  if (!soup.source_face.empty()) face.column<std::int32_t>("source_face", soup.source_face);
  write_ply(work, path, ply);
}

std::vector<Index> layout_faces(const Work& work, const LayoutView& layout) {
  const RefinedMesh& refined = *layout.refined;
  const Index faces = refined.mesh.face_count();
  std::vector<Index> start(std::size_t{layout.soup->face_count()} + 1, 0);
  for (Index f = 0; f < faces; ++f) ++start[layout.face_order[refined.parent[f]]];
  exclusive_scan<Index>(work, start);
  std::vector<Index> order(faces);
  for (Index f = 0; f < faces; ++f) order[start[layout.face_order[refined.parent[f]]]++] = f;
  return order;
}

void write_layout_ply(const Work& work, const std::filesystem::path& path, const LayoutView& layout) {
  const RefinedMesh& refined = *layout.refined;
  const std::vector<Index> order = layout_faces(work, layout);
  std::vector<Index> corner(order.size() * 3);
  for_each(work, Cost::light, order.size(), [&](std::size_t i) {
    for (int k = 0; k < 3; ++k) corner[3 * i + k] = layout_vertex(layout, refined.mesh.corner[3 * order[i] + k]);
  });

  PlyFile ply;
  ply.comment("intarsia layout: a refinement of the input whose edges carry all curves");
  auto& vertex = ply.element("vertex", layout_vertex_count(layout));
  const char* axis[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i)
    vertex.column<double>(axis[i],
                          [&, i](std::size_t v) { return layout_point_by_number(layout, static_cast<Index>(v))[i]; });
  ply.element("face", order.size())
      .triangles(corner)
      .column<std::int32_t>("patch", [&](std::size_t i) { return layout.labels->patch_of_face[order[i]]; })
      .column<std::int32_t>("parent", [&](std::size_t i) { return layout.face_order[refined.parent[order[i]]]; });
  write_ply(work, path, ply);
}

void write_network_ply(const Work& work, const std::filesystem::path& path, const LayoutView& layout) {
  const LayoutGraph& graph = *layout.graph;
  std::vector<Index> number(layout.refined->mesh.vertex_count(), kNone), vertex;
  std::vector<Index> v1, v2, curve;
  std::vector<CurveKind> kind;
  const auto named = [&](Index v) {
    if (number[v] == kNone) number[v] = static_cast<Index>(vertex.size()), vertex.push_back(v);
    return number[v];
  };
  for (Index a = 0; a < graph.arc_count(); ++a) {
    const auto row = graph.arc.row(a);
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      v1.push_back(named(row[i])), v2.push_back(named(row[i + 1]));
      curve.push_back(a), kind.push_back(graph.kind[a]);
    }
  }
  PlyFile ply;
  ply.comment("intarsia network: kind 0 ridge, 1 valley, 2 sharp, 3 border, 4 extension, 5 subdivision, 6 given");
  auto& element = ply.element("vertex", vertex.size());
  const char* axis[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i)
    element.column<double>(axis[i], [&, i](std::size_t v) { return layout_point(layout, vertex[v])[i]; });
  ply.element("edge", v1.size())
      .column<std::int32_t>("vertex1", v1)
      .column<std::int32_t>("vertex2", v2)
      .column<std::int32_t>("curve", curve)
      .column<std::int32_t>("kind", kind);
  write_ply(work, path, ply);
}

}  // namespace intarsia
