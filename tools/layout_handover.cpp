#include "tools/layout_handover.h"

#include <fstream>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/io/read_labels.h"
#include "tools/picture/palette.h"

namespace intarsia::tools {
namespace {

std::vector<Index> input_labels(const Work& work, const std::filesystem::path& path, Index patches) {
  std::vector<Index> label;
  for (const int l : read_face_labels(work, path, "patch")) {
    if (l < 0 || static_cast<Index>(l) >= patches)
      throw Error(ErrorCode::bad_file, fmt::format("{}: face {} has patch {}, which does not exist; let intarsia run "
                                                   "write it again",
                                                   path.string(), label.size(), l));
    label.push_back(static_cast<Index>(l));
  }
  return label;
}

// Of the file that was run, or else of the folder.
std::string input_name(const std::filesystem::path& folder) {
  const nlohmann::json report =
      nlohmann::json::parse(std::ifstream(folder / "report.json", std::ios::binary), nullptr, false);
  const nlohmann::json::json_pointer path("/input/path");
  if (!report.is_discarded() && report.contains(path) && report[path].is_string())
    return std::filesystem::path(report[path].get<std::string>()).filename().string();
  return std::filesystem::weakly_canonical(folder).filename().string();
}

std::vector<Index> counting(Index n) {
  std::vector<Index> out(n);
  std::iota(out.begin(), out.end(), Index{0});
  return out;
}

}  // namespace

std::unique_ptr<LayoutHandover> LayoutHandover::read(const Work& work, const std::filesystem::path& folder) {
  LayoutFromFile layout = read_result_folder(work, folder);
  auto result = of(work, folder, layout);
  result->layout_ = std::move(layout);
  result->look_at(result->layout_);
  return result;
}

std::unique_ptr<LayoutHandover> LayoutHandover::of(const Work& work, const std::filesystem::path& folder,
                                                   const LayoutFromFile& layout) {
  std::unique_ptr<LayoutHandover> result(new LayoutHandover);
  LayoutHandover& r = *result;
  const Index patches = layout.graph.patch_count();
  r.labels_ = {layout.label, patches};
  r.vertex_order_ = counting(layout.soup.vertex_count());
  r.face_order_ = counting(layout.soup.face_count());
  r.face_patch_ = input_labels(work, folder / "patches.ply", patches);
  if (r.face_patch_.size() != r.face_order_.size())
    throw Error(ErrorCode::bad_file, (folder / "patches.ply").string() +
                                         ": it has other faces than triangles; let "
                                         "intarsia run write it again");
  for (const Rgb& c : patch_colours(work, adjacent_patches(work, layout.refined.mesh, layout.label, patches)))
    r.colour_.push_back({c.r, c.g, c.b});
  r.handover_.name = input_name(folder);
  r.look_at(layout);
  complete(work, r.handover_);
  return result;
}

void LayoutHandover::look_at(const LayoutFromFile& layout) {
  LayoutView& view = handover_.layout;
  view.soup = &layout.soup;
  view.vertex_order = vertex_order_, view.face_order = face_order_;
  view.centre = layout.box.centre, view.diagonal = layout.box.diagonal;
  view.refined = &layout.refined, view.labels = &labels_, view.graph = &layout.graph;
  view.interior = &no_interior_, view.mesh = layout.mesh, view.face_patch = face_patch_;
  view.patch_colour = colour_;
}

}  // namespace intarsia::tools
