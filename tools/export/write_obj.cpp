#include "tools/export/write_obj.h"

#include <algorithm>

#include "engine/data/patch_labels.h"
#include "tools/export/file_writer.h"
#include "tools/picture/lines.h"

namespace intarsia::tools {
namespace {

void put_point(FileWriter& out, const Vec3& p, bool single) {
  if (single)
    out.text("v {} {} {}\n", static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  else
    out.text("v {} {} {}\n", p.x(), p.y(), p.z());
}

void put_material(FileWriter& out, const std::string& name, int r, int g, int b) {
  out.text("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\nKa 0 0 0\nKs 0 0 0\nd 1\nillum 1\n\n", name, r / 255., g / 255.,
           b / 255.);
}

}  // namespace

void write_patches_obj(const Work& work, const std::filesystem::path& path, const Handover& handover) {
  const Soup& soup = *handover.layout.soup;
  const Index patches = handover.patch_count();
  PatchLabels labels{handover.input_patch, patches + 1};  // the last row: triangles that were left out
  for (Index& p : labels.patch_of_face) p = std::min(p, patches);
  const Csr faces = faces_of_patches(labels);
  FileWriter out(path);
  out.text("# intarsia patches: the input's triangles, a group and a material for each patch\nmtllib patches.mtl\n");
  for (Index v = 0; v < soup.vertex_count(); ++v) {
    put_point(out, handover.input_point(v), handover.single);
    if (v % 4096 == 0) work.check();
  }
  for (Index p = 0; p < faces.rows(); ++p) {
    if (faces.row(p).empty()) continue;
    if (p < patches)
      out.text("g patch_{0}\nusemtl patch_{0}\n", p);
    else
      out.text("g left_out\nusemtl left_out\n");
    for (const Index f : faces.row(p))
      out.text("f {} {} {}\n", soup.corner[3 * f] + 1, soup.corner[3 * f + 1] + 1, soup.corner[3 * f + 2] + 1);
    work.check();
  }
  out.commit();
}

void write_patches_mtl(const std::filesystem::path& path, const Handover& handover) {
  FileWriter out(path);
  out.text("# intarsia: colours of patches and of the kinds of curves\n");
  for (Index p = 0; p < handover.patch_count(); ++p) {
    const auto& c = handover.layout.patch_colour[p];
    put_material(out, fmt::format("patch_{}", p), c[0], c[1], c[2]);
  }
  const std::vector<Index>& patch = handover.input_patch;
  if (std::find(patch.begin(), patch.end(), kNone) != patch.end()) put_material(out, "left_out", 128, 128, 128);
  for (int k = 0; k < kCurveKinds; ++k) {
    const Rgb c = style_of(static_cast<CurveKind>(k)).colour;
    put_material(out, name_of(static_cast<CurveKind>(k)), c.r, c.g, c.b);
  }
  out.commit();
}

void write_network_obj(const std::filesystem::path& path, const Handover& handover) {
  const LayoutGraph& graph = *handover.layout.graph;
  std::vector<Index> number(handover.layout.refined->mesh.vertex_count(), 0);  // 0: not written yet
  FileWriter out(path);
  out.text("# intarsia network: a polyline for each arc\nmtllib patches.mtl\n");
  Index next = 0;
  for (const Index v : graph.arc.item)
    if (number[v] == 0) number[v] = ++next, put_point(out, layout_point(handover.layout, v), false);
  for (Index a = 0; a < graph.arc_count(); ++a) {
    out.text("g arc_{}\nusemtl {}\nl", a, name_of(graph.kind[a]));
    for (const Index v : graph.arc.row(a)) out.text(" {}", number[v]);
    out.text("\n");
  }
  out.commit();
}

}  // namespace intarsia::tools
