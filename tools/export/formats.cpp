#include "tools/export/formats.h"

#include <algorithm>

#include "engine/base/nearest_word.h"
#include "tools/export/write_glb.h"
#include "tools/export/write_labels.h"
#include "tools/export/write_obj.h"
#include "tools/export/write_quadwild.h"
#include "tools/export/write_vtp.h"

namespace intarsia::tools {
namespace {

struct Format {
  std::string name;
  std::vector<std::string> files;
};

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {{"vtp", {"patches.vtp", "network.vtp", "features.vtp"}},
                                          {"obj", {"patches.obj", "patches.mtl", "network.obj"}},
                                          {"seg", {"labels.seg"}},
                                          {"npy", {"labels.npy"}},
                                          {"csv", {"patches.csv"}},
                                          {"polylines", {"network.polylines.txt"}},
                                          {"glb", {"layout.glb"}},
                                          {"html", {"view.html"}},
                                          {"quadwild", quadwild_names()}};
  return all;
}

std::vector<std::string> known_items() {
  std::vector<std::string> items;
  for (const Format& f : formats()) items.push_back(f.name);
  items.insert(items.end(), {"all", "none"});
  for (const std::string& name : export_names()) items.push_back(name);
  return items;
}

[[noreturn]] void unknown(const std::string& item) {
  std::string names;
  for (const Format& f : formats()) names += f.name + ", ";
  throw Error(ErrorCode::bad_argument, "--write: there is no '" + item + "'; did you mean '" +
                                           nearest_word(item, known_items()) + "'? Known are " + names +
                                           "all, none and names of files");
}

}  // namespace

std::vector<std::string> export_names() {
  std::vector<std::string> names;
  for (const Format& f : formats()) names.insert(names.end(), f.files.begin(), f.files.end());
  return names;
}

FileSet export_files(const std::vector<std::string>& list) {
  FileSet files;
  const std::vector<std::string> names = export_names();
  for (const std::string& item : list) {
    const auto format =
        std::find_if(formats().begin(), formats().end(), [&](const Format& f) { return f.name == item; });
    if (item == "all")
      files.insert(names.begin(), names.end());
    else if (format != formats().end())
      files.insert(format->files.begin(), format->files.end());
    else if (std::find(names.begin(), names.end(), item) != names.end())
      files.insert(item);
    else if (item != "none" && item != "ply" && item != "json" && item != "png")  // in every result
      unknown(item);
  }
  return files;
}

std::vector<std::string> default_exports() { return {"csv", "npy", "html"}; }

std::string export_help() {
  return "more files to write, separated by commas: vtp obj seg npy csv polylines glb html quadwild, names of files, "
         "all, none";
}

void write_exports(const Work& work, const Handover& handover, const FileSet& files,
                   const std::function<std::filesystem::path(const std::string&)>& path_of) {
  const auto wanted = [&](const char* name) {
    work.check();
    return files.contains(name);
  };
  if (wanted("patches.vtp")) write_patches_vtp(path_of("patches.vtp"), handover);
  if (wanted("network.vtp")) write_network_vtp(path_of("network.vtp"), handover);
  if (wanted("features.vtp") && handover.features) write_features_vtp(path_of("features.vtp"), *handover.features);
  if (wanted("patches.obj")) write_patches_obj(work, path_of("patches.obj"), handover);
  if (wanted("network.obj")) write_network_obj(path_of("network.obj"), handover);
  if (wanted("patches.mtl") || wanted("patches.obj") || wanted("network.obj"))
    write_patches_mtl(path_of("patches.mtl"), handover);
  if (wanted("labels.seg")) write_labels_seg(path_of("labels.seg"), handover);
  if (wanted("labels.npy")) write_labels_npy(path_of("labels.npy"), handover);
  if (wanted("patches.csv")) write_patches_csv(path_of("patches.csv"), handover);
  if (wanted("network.polylines.txt")) write_network_polylines(path_of("network.polylines.txt"), handover);
  if (wanted("layout.glb")) write_layout_glb(work, path_of("layout.glb"), handover);
  const std::vector<std::string> quadwild = quadwild_names();
  if (std::any_of(quadwild.begin(), quadwild.end(), [&](const std::string& n) { return files.contains(n); }))
    write_quadwild(work, handover, path_of);
}

}  // namespace intarsia::tools
