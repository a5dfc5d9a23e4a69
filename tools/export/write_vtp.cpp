#include "tools/export/write_vtp.h"

#include "tools/export/vtp_file.h"

namespace intarsia::tools {

void write_patches_vtp(const std::filesystem::path& path, const Handover& handover) {
  const Soup& soup = *handover.layout.soup;
  VtpFile vtp;
  const auto place = [&](std::size_t v) { return handover.input_point(static_cast<Index>(v)); };
  if (handover.single)
    vtp.points<float>(soup.vertex_count(), place);
  else
    vtp.points<double>(soup.vertex_count(), place);
  vtp.triangles(soup.face_count(), [&](std::size_t c) { return soup.corner[c]; });
  vtp.cell_array<std::int32_t>("patch_id", [&](std::size_t f) {
    return static_cast<std::int32_t>(handover.input_patch[f]);  // kNone: -1
  });
  vtp.write(path);
}

void write_network_vtp(const std::filesystem::path& path, const Handover& handover) {
  const LayoutGraph& graph = *handover.layout.graph;
  const std::vector<Index>& item = graph.arc.item;
  const Index arcs = graph.arc_count();
  std::vector<std::int32_t> node(item.size(), -1);
  for (Index a = 0; a < arcs; ++a) {
    node[graph.arc.offset[a]] = static_cast<std::int32_t>(graph.start[a]);
    node[graph.arc.offset[a + 1] - 1] = static_cast<std::int32_t>(graph.end[a]);
  }
  const auto patch = [](Index p) { return p == kNone ? -1 : static_cast<std::int32_t>(p); };
  VtpFile vtp;
  vtp.points<double>(item.size(), [&](std::size_t i) { return layout_point(handover.layout, item[i]); });
  vtp.lines(
      arcs, item.size(), [](std::size_t i) { return i; }, [&](std::size_t a) { return graph.arc.offset[a + 1]; });
  vtp.cell_array<std::int32_t>("arc", [](std::size_t a) { return a; });
  vtp.cell_array<std::int32_t>("kind", [&](std::size_t a) { return static_cast<int>(graph.kind[a]); });
  vtp.cell_array<std::int32_t>("left", [&](std::size_t a) { return patch(graph.left[a]); });
  vtp.cell_array<std::int32_t>("right", [&](std::size_t a) { return patch(graph.right[a]); });
  vtp.cell_array<double>("length", [&](std::size_t a) { return graph.length[a] * handover.layout.diagonal; });
  vtp.cell_array<double>("turn", [&](std::size_t a) { return graph.strength[a]; });
  vtp.point_array<std::int32_t>("vertex", [&](std::size_t i) { return layout_vertex(handover.layout, item[i]); });
  vtp.point_array<std::int32_t>("node", [&](std::size_t i) { return node[i]; });
  vtp.write(path);
}

void write_features_vtp(const std::filesystem::path& path, const FeatureLines& lines) {
  VtpFile vtp;
  vtp.points<double>(lines.point.size(), [&](std::size_t i) { return lines.point[i]; });
  vtp.lines(
      lines.count(), lines.point.size(), [](std::size_t i) { return i; },
      [&](std::size_t c) { return lines.offset[c + 1]; });
  vtp.cell_array<std::int32_t>("kind", [&](std::size_t c) { return static_cast<int>(lines.kind[c]); });
  vtp.cell_array<std::int32_t>("chosen", [&](std::size_t c) { return lines.chosen[c]; });
  const std::pair<const char*, const std::vector<Real>*> measures[] = {
      {"length", &lines.length}, {"L", &lines.L}, {"R", &lines.R}, {"T", &lines.T}};
  for (const auto& [name, value] : measures)
    vtp.cell_array<double>(name, [v = value](std::size_t c) { return (*v)[c]; });
  vtp.point_array<double>("curvature", [&](std::size_t i) { return lines.curvature[i]; });
  vtp.point_array<double>("radius", [&](std::size_t i) { return lines.radius[i]; });
  vtp.write(path);
}

}  // namespace intarsia::tools
