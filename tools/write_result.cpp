#include "tools/write_result.h"

#include "graph/input_numbers.h"
#include "tools/picture/palette.h"
#include "tools/picture/png_file.h"
#include "tools/preview.h"
#include "tools/view/write_page.h"

namespace intarsia::tools {
namespace {

std::vector<Rgb> colours_of(const Work& work, const graph::Layout& layout) {
  return patch_colours(work,
                       adjacent_patches(work, layout.refined.mesh, layout.labels.patch_of_face, layout.labels.count));
}

// A view of its arguments, which must outlive it.
Handover handover_of(const Work& work, const Soup& soup, const graph::Surface& surface, const graph::Layout& layout,
                     const std::vector<std::array<std::uint8_t, 3>>& colour, const std::string& name) {
  Handover handover;
  handover.layout = graph::layout_view(soup, surface, layout);
  handover.layout.patch_colour = colour;
  handover.name = name;
  complete(work, handover);
  return handover;
}

std::vector<std::array<std::uint8_t, 3>> bytes_of(const std::vector<Rgb>& colour) {
  std::vector<std::array<std::uint8_t, 3>> rgb;
  rgb.reserve(colour.size());
  for (const Rgb& c : colour) rgb.push_back({c.r, c.g, c.b});
  return rgb;
}

void write_layout_files(const Work& work, const OutputFolder& folder, const Handover& handover, const FileSet& files) {
  const LayoutView& layout = handover.layout;
  write_patches_ply(work, folder.file("patches.ply"), layout);
  write_layout_ply(work, folder.file("layout.ply"), layout);
  write_network_ply(work, folder.file("network.ply"), layout);
  write_network_json(work, folder.file("network.json"), layout);
  if (files.contains("view.html")) write_page(work, folder.file("view.html"), handover);
  write_exports(work, handover, files, [&](const std::string& name) { return folder.file(name); });
}

// The run's lines cost a copy: made only where a file needs them.
bool needs_features(const FileSet& files) { return files.contains("features.vtp") || files.contains("view.html"); }

void draw(const Work& work, const OutputFolder& folder, Strip strip, const Pictures& pictures) {
  strip.options.view = pictures.view;
  write_png(folder.file("preview.png"), draw_strip(work, strip));
  if (!pictures.panels.empty()) write_panels(work, strip, pictures.panels);
}

Written count_files(const OutputFolder& folder) {
  Written written;
  const std::filesystem::path fresh = folder.file("patches.ply").parent_path();
  for (const std::string& name : result_names()) {
    std::error_code error;
    const auto size = std::filesystem::file_size(fresh / name, error);
    if (!error) ++written.files, written.bytes += size;
  }
  return written;
}

}  // namespace

std::vector<std::string> result_names() {
  std::vector<std::string> names = {"patches.ply",  "layout.ply",  "network.ply",
                                    "network.json", "report.json", "preview.png"};
  for (std::string& name : export_names()) names.push_back(std::move(name));
  return names;
}

Written write_result(const Work& work, const OutputFolder& folder, const Soup& soup, const graph::Surface& surface,
                     const graph::Ridges& ridges, const graph::Ridges& valleys, const graph::Sharp& sharp,
                     const graph::Network& network, const graph::Layout& layout, const Pictures& pictures,
                     const Exports& exports) {
  const std::vector<Rgb> colour = colours_of(work, layout);
  const auto rgb = bytes_of(colour);
  Handover handover = handover_of(work, soup, surface, layout, rgb, exports.name);
  FeatureLines features;
  FileSet files = exports.files;
  if (exports.is_default && soup.face_count() > kPageFaces) files.erase("view.html");
  if (needs_features(files))
    features = feature_lines(work, surface, ridges, valleys, sharp, network), handover.features = &features;
  write_layout_files(work, folder, handover, files);
  draw(work, folder, preview_strip({surface, ridges, valleys, sharp, network, layout, colour}), pictures);
  return count_files(folder);
}

Written write_baseline(const Work& work, const OutputFolder& folder, const Soup& soup, const graph::Surface& surface,
                       const graph::Patches& patches, const graph::Layout& layout, const std::string& method,
                       const Pictures& pictures, const Exports& exports) {
  const std::vector<Rgb> colour = colours_of(work, layout);
  const auto rgb = bytes_of(colour);
  write_layout_files(work, folder, handover_of(work, soup, surface, layout, rgb, exports.name), exports.files);
  draw(work, folder, baseline_strip({surface, patches, layout, method, colour}), pictures);
  return count_files(folder);
}

}  // namespace intarsia::tools
