#include "tools/write_evaluation.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/io/write_ply.h"
#include "tools/deviation.h"
#include "tools/layout_handover.h"
#include "tools/picture/best_view.h"
#include "tools/picture/palette.h"
#include "tools/picture/png_file.h"
#include "tools/picture/strip.h"
#include "tools/rebuilt_shape.h"
#include "tools/view/write_page.h"

namespace intarsia::tools {
namespace {

using graph::Rebuilt;
using nlohmann::json;

std::string title_of(const std::string& name) {
  if (name == "triangulated") return "triangulated";
  if (name == "triangulated_area") return "by area alone";
  return name == "transfinite" ? "transfinite" : "filled";
}

std::string file_of(const std::string& name) {
  return "recon-" + (name == "triangulated_area" ? std::string("area") : name) + ".ply";
}

void write_rebuilt(const Work& work, const std::filesystem::path& path, const Rebuilt& r,
                   const kernels::BoxTransform& box, const std::vector<Rgb>& colour) {
  const kernels::Reconstruction& s = r.surface;
  PlyFile ply;
  ply.comment("rebuilt from the curves of a layout; int patch per face");
  auto& vertex = ply.element("vertex", s.point.size());
  const char* axis[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i)
    vertex.column<double>(axis[i], [&, i](std::size_t v) { return box.to_input(s.point[v])[i]; });
  auto& face = ply.element("face", s.patch.size());
  face.triangles(s.corner).column<std::int32_t>("patch", s.patch);
  face.column<std::uint8_t>("red", [&](std::size_t f) { return colour[s.patch[f]].r; });
  face.column<std::uint8_t>("green", [&](std::size_t f) { return colour[s.patch[f]].g; });
  face.column<std::uint8_t>("blue", [&](std::size_t f) { return colour[s.patch[f]].b; });
  write_ply(work, path, ply);
}

std::vector<Rgb> colours_of_patches(const Work& work, const LayoutFromFile& layout) {
  return patch_colours(work, adjacent_patches(work, layout.refined.mesh, layout.label, layout.graph.patch_count()));
}

// The arcs as polylines on the refined mesh.
Lines arc_lines(const LayoutFromFile& layout) {
  Lines lines;
  std::vector<Vec3> point;
  for (Index a = 0; a < layout.graph.arc_count(); ++a) {
    point.clear();
    for (const Index v : layout.graph.arc.row(a)) point.push_back(layout.refined.mesh.view().point(v));
    lines.add(point, kBorderLine);
  }
  return lines;
}

std::string percent(Real value) { return fmt::format("{:.3g} %", 100 * value); }

}  // namespace

std::vector<std::string> evaluation_names() {
  return {"recon-triangulated.ply",
          "recon-area.ply",
          "recon-transfinite.ply",
          "recon-filled.ply",
          "deviation.ply",
          "eval.json",
          "eval.png"};
}

Image draw_evaluation(const Work& work, const LayoutFromFile& layout, const graph::Evaluation& evaluation,
                      const std::optional<View>& view) {
  const auto made = evaluation.made();
  const std::vector<Rgb> colour = colours_of_patches(work, layout);
  // One scale for all maps, so that they can be compared.
  std::vector<Real> all, weight;
  for (const auto& [name, r] : made) {
    for (const Real rms : r->distance.face_rms) all.push_back(100 * rms);
    weight.insert(weight.end(), r->distance.face_area.begin(), r->distance.face_area.end());
  }
  const ColourScale scale = scale_for(all, weight, "distance, % of the diagonal");

  Strip strip;
  strip.options.legend = false;
  strip.options.width = 480, strip.options.height = 440;
  strip.options.per_row = static_cast<int>(made.size()) + 1;
  Shape input = shape_of(layout.mesh.view());
  strip.options.view = view ? *view : best_view(work, input);

  Shape patched = shape_of(layout.refined.mesh.view());
  patched.face_label = layout.label, patched.label_colour = colour;
  strip.add({"layout", fmt::format("{} patches, q {:.2f} median", evaluation.patches, evaluation.compactness.median),
             patched, arc_lines(layout)});
  for (const auto& [name, r] : made) {
    const Shape shape = shape_of(r->surface, colour, name == "filled" || name == "transfinite");
    strip.add({title_of(name), fmt::format("{} triangles", r->surface.patch.size()), shape,
               border_lines(r->surface, kBorderLine)});
  }
  strip.add({"input", fmt::format("{} triangles", layout.mesh.face_count()), input, {}});
  std::vector<std::vector<Rgb>> map;
  map.reserve(made.size());
  for (const auto& [name, r] : made) {
    std::vector<Real> value = r->distance.face_rms;
    for (Real& v : value) v *= 100;
    map.push_back(tools::colours_of(work, value, scale));
    Shape shape = input;
    shape.face_colour = map.back();
    strip.add({"distance",
               fmt::format("RMS {}, largest {}", percent(r->distance.rms()), percent(r->distance.hausdorff())),
               shape,
               {}});
  }
  return with_scale_bar(draw_strip(work, strip), scale);
}

void write_evaluation(const Work& work, const OutputFolder& folder, const LayoutFromFile& layout,
                      const graph::Evaluation& evaluation, const std::optional<View>& view) {
  const std::vector<Rgb> colour = colours_of_patches(work, layout);
  for (const auto& [name, rebuilt] : evaluation.made())
    write_rebuilt(work, folder.file(file_of(name)), *rebuilt, layout.box, colour);
  const Deviation deviation{layout.soup, evaluation.made().front().second->distance, layout.box.diagonal};
  write_deviation_ply(work, folder.file("deviation.ply"), deviation, deviation_scale(deviation));
  write_png(folder.file("eval.png"), draw_evaluation(work, layout, evaluation, view));
}

void write_evaluated_page(const Work& work, const std::filesystem::path& path, const std::filesystem::path& earlier,
                          const LayoutFromFile& layout, const graph::Evaluation& evaluation) {
  const auto made = evaluation.made();
  const auto& [name, rebuilt] = made.front();
  const kernels::SurfaceDistance& d = rebuilt->distance;
  PageDeviation deviation;
  deviation.vertex = d.vertex_distance;
  for (const auto& patch : rebuilt->patch) deviation.patch_rms.push_back(patch.rms);
  deviation.top = deviation_scale({layout.soup, d, layout.box.diagonal}).top / 100;
  deviation.caption =
      fmt::format("{}: RMS {}, largest {} of the diagonal", title_of(name), percent(d.rms()), percent(d.hausdorff()));
  PageOptions options;
  options.deviation = &deviation;
  options.earlier = read_page_parts(earlier);
  write_page(work, path, LayoutHandover::of(work, earlier.parent_path(), layout)->handover(), options);
}

}  // namespace intarsia::tools
