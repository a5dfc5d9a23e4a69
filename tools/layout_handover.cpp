#include "tools/layout_handover.h"

#include <numeric>

#include <fmt/format.h>

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

std::vector<Index> counting(Index n) {
  std::vector<Index> out(n);
  std::iota(out.begin(), out.end(), Index{0});
  return out;
}

}  // namespace

std::unique_ptr<LayoutHandover> LayoutHandover::read(const Work& work, const std::filesystem::path& folder) {
  std::unique_ptr<LayoutHandover> result(new LayoutHandover);
  LayoutHandover& r = *result;
  r.layout_ = read_result_folder(work, folder);
  const Index patches = r.layout_.graph.patch_count();
  r.labels_ = {r.layout_.label, patches};
  r.vertex_order_ = counting(r.layout_.soup.vertex_count());
  r.face_order_ = counting(r.layout_.soup.face_count());
  r.face_patch_ = input_labels(work, folder / "patches.ply", patches);
  if (r.face_patch_.size() != r.face_order_.size())
    throw Error(ErrorCode::bad_file, (folder / "patches.ply").string() +
                                         ": it has other faces than triangles; let "
                                         "intarsia run write it again");
  for (const Rgb& c : patch_colours(work, adjacent_patches(work, r.layout_.refined.mesh, r.layout_.label, patches)))
    r.colour_.push_back({c.r, c.g, c.b});
  LayoutView& view = r.handover_.layout;
  view.soup = &r.layout_.soup;
  view.vertex_order = r.vertex_order_, view.face_order = r.face_order_;
  view.centre = r.layout_.box.centre, view.diagonal = r.layout_.box.diagonal;
  view.refined = &r.layout_.refined, view.labels = &r.labels_, view.graph = &r.layout_.graph;
  view.interior = &r.no_interior_, view.mesh = r.layout_.mesh, view.face_patch = r.face_patch_;
  view.patch_colour = r.colour_;
  r.handover_.name = std::filesystem::weakly_canonical(folder).filename().string();
  complete(work, r.handover_);
  return result;
}

}  // namespace intarsia::tools
