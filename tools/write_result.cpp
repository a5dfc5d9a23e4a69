#include "tools/write_result.h"

#include "tools/picture/palette.h"
#include "tools/picture/png_file.h"
#include "tools/preview.h"

namespace intarsia::tools {
namespace {

std::vector<Rgb> colours_of(const Work& work, const graph::Layout& layout) {
  return patch_colours(work,
                       adjacent_patches(work, layout.refined.mesh, layout.labels.patch_of_face, layout.labels.count));
}

void write_layout_files(const Work& work, const OutputFolder& folder, const Soup& soup, const graph::Surface& surface,
                        const graph::Layout& layout, const std::vector<Rgb>& colour) {
  std::vector<std::array<std::uint8_t, 3>> rgb;
  for (const Rgb& c : colour) rgb.push_back({c.r, c.g, c.b});
  LayoutView parts;
  parts.soup = &soup;
  parts.vertex_order = surface.order.vertex, parts.face_order = surface.order.face;
  parts.copies = surface.mended.copy, parts.twin = surface.mended.twin, parts.twin_of = surface.mended.twin_of;
  parts.centre = surface.box.centre, parts.diagonal = surface.box.diagonal;
  parts.refined = &layout.refined, parts.labels = &layout.labels, parts.graph = &layout.graph;
  parts.interior = &layout.interior, parts.mesh = surface.mesh, parts.face_patch = layout.face_patch;
  parts.patch_colour = rgb;

  write_patches_ply(work, folder.file("patches.ply"), parts);
  write_layout_ply(work, folder.file("layout.ply"), parts);
  write_network_ply(work, folder.file("network.ply"), parts);
  write_network_json(work, folder.file("network.json"), parts);
}

void draw(const Work& work, const OutputFolder& folder, Strip strip, const Pictures& pictures) {
  strip.options.view = pictures.view;
  write_png(folder.file("preview.png"), draw_strip(work, strip));
  if (!pictures.panels.empty()) write_panels(work, strip, pictures.panels);
}

Written count_files(const OutputFolder& folder) {
  Written written;
  for (const std::string& name : result_names()) {
    std::error_code error;
    const auto size = std::filesystem::file_size(folder.file(name), error);
    if (!error) ++written.files, written.bytes += size;
  }
  return written;
}

}  // namespace

std::vector<std::string> result_names() {
  return {"patches.ply", "layout.ply", "network.ply", "network.json", "report.json", "preview.png"};
}

Written write_result(const Work& work, const OutputFolder& folder, const Soup& soup, const graph::Surface& surface,
                     const graph::Ridges& ridges, const graph::Ridges& valleys, const graph::Sharp& sharp,
                     const graph::Network& network, const graph::Layout& layout, const Pictures& pictures) {
  const std::vector<Rgb> colour = colours_of(work, layout);
  write_layout_files(work, folder, soup, surface, layout, colour);
  draw(work, folder, preview_strip({surface, ridges, valleys, sharp, network, layout, colour}), pictures);
  return count_files(folder);
}

Written write_baseline(const Work& work, const OutputFolder& folder, const Soup& soup, const graph::Surface& surface,
                       const graph::Patches& patches, const graph::Layout& layout, const std::string& method,
                       const Pictures& pictures) {
  const std::vector<Rgb> colour = colours_of(work, layout);
  write_layout_files(work, folder, soup, surface, layout, colour);
  draw(work, folder, baseline_strip({surface, patches, layout, method, colour}), pictures);
  return count_files(folder);
}

}  // namespace intarsia::tools
