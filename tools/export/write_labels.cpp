#include "tools/export/write_labels.h"

#include <algorithm>
#include <numbers>

#include "tools/export/file_writer.h"

namespace intarsia::tools {

void write_labels_seg(const std::filesystem::path& path, const Handover& handover) {
  FileWriter out(path);
  for (const Index p : handover.input_patch) out.text("{}\n", static_cast<std::int32_t>(p));  // kNone: -1
  out.commit();
}

void write_labels_npy(const std::filesystem::path& path, const Handover& handover) {
  std::string header =
      fmt::format("{{'descr': '<i4', 'fortran_order': False, 'shape': ({},), }}", handover.input_patch.size());
  const std::size_t before = 10;  // magic, version, length of the header; data begin at a multiple of 64
  header.append(63 - (before + header.size()) % 64, ' ');
  header += '\n';
  FileWriter out(path);
  out.bytes("\x93NUMPY");
  out.put<std::uint8_t>(1), out.put<std::uint8_t>(0);
  out.put(static_cast<std::uint16_t>(header.size()));
  out.bytes(header);
  for (const Index p : handover.input_patch) out.put(static_cast<std::int32_t>(p));
  out.commit();
}

void write_network_polylines(const std::filesystem::path& path, const Handover& handover) {
  const LayoutGraph& graph = *handover.layout.graph;
  FileWriter out(path);
  for (Index a = 0; a < graph.arc_count(); ++a) {
    out.text("{}", graph.arc.row(a).size());
    for (const Index v : graph.arc.row(a)) {
      const Vec3 p = layout_point(handover.layout, v);
      out.text(" {} {} {}", p.x(), p.y(), p.z());
    }
    out.text("\n");
  }
  out.commit();
}

Real PatchRow::compactness() const { return area > 0 ? perimeter * perimeter / (4 * std::numbers::pi * area) : 0; }

std::vector<PatchRow> patch_rows(const Handover& handover) {
  const LayoutView& layout = handover.layout;
  const LayoutGraph& graph = *layout.graph;
  const MeshView mesh = layout.refined->mesh;
  std::vector<PatchRow> rows(graph.patch_count());
  for (const Index p : handover.input_patch)
    if (p != kNone) ++rows[p].triangles;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto [i, j, k] = mesh.face(f);
    const Vec3 a = mesh.point(i), b = mesh.point(j), c = mesh.point(k), n = (b - a).cross(c - a) / 2;
    PatchRow& row = rows[layout.labels->patch_of_face[f]];
    const Real area = n.norm();
    row.area += area, row.normal += n, row.centroid += area * (a + b + c) / 3;
  }
  const Real unit = layout.diagonal;
  for (PatchRow& row : rows) {
    if (row.area > 0) row.normal /= row.area, row.centroid /= row.area;
    row.centroid = layout.centre + unit * row.centroid, row.area *= unit * unit;
  }
  for (Index a = 0; a < graph.arc_count(); ++a)
    for (const auto& [p, other] : {std::pair{graph.left[a], graph.right[a]}, {graph.right[a], graph.left[a]}}) {
      if (p == kNone) continue;
      ++rows[p].sides, rows[p].perimeter += unit * graph.length[a];
      if (other != kNone && other != p) rows[p].neighbours.push_back(other);
    }
  for (Index p = 0; p < rows.size(); ++p) {
    rows[p].loops = static_cast<Index>(graph.patch_loops.row(p).size());
    auto& n = rows[p].neighbours;
    std::sort(n.begin(), n.end());
    n.erase(std::unique(n.begin(), n.end()), n.end());
  }
  return rows;
}

void write_patches_csv(const std::filesystem::path& path, const Handover& handover) {
  FileWriter out(path);
  out.text(
      "patch,triangles,area,perimeter,compactness,flatness,centroid_x,centroid_y,centroid_z,normal_x,normal_y,"
      "normal_z,loops,sides,neighbours,red,green,blue\n");
  const std::vector<PatchRow> rows = patch_rows(handover);
  for (Index p = 0; p < rows.size(); ++p) {
    const PatchRow& r = rows[p];
    const Real flatness = r.normal.norm();
    const Vec3 normal = flatness > 0 ? Vec3(r.normal / flatness) : Vec3(Vec3::Zero());
    const auto& c = handover.layout.patch_colour[p];
    out.text("{},{},{:.9g},{:.9g},{:.6g},{:.6g},{:.9g},{:.9g},{:.9g},{:.6g},{:.6g},{:.6g},{},{},{},{},{},{}\n", p,
             r.triangles, r.area, r.perimeter, r.compactness(), flatness, r.centroid.x(), r.centroid.y(),
             r.centroid.z(), normal.x(), normal.y(), normal.z(), r.loops, r.sides, fmt::join(r.neighbours, " "), c[0],
             c[1], c[2]);
  }
  out.commit();
}

}  // namespace intarsia::tools
