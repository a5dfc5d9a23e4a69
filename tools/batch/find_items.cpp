#include "tools/batch/find_items.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <set>

#include "engine/base/error.h"
#include "engine/io/extension.h"

namespace intarsia::tools {
namespace {

namespace fs = std::filesystem;

bool is_mesh(const fs::path& file) {
  const std::string ending = lower_extension(file);
  return ending == ".ply" || ending == ".obj" || ending == ".stl" || ending == ".off";
}

// Written by a run: its files are meshes too, but nobody means them.
bool is_result(const fs::path& folder) {
  std::error_code failed;
  return fs::exists(folder / "network.json", failed) && fs::exists(folder / "layout.ply", failed);
}

std::vector<fs::path> meshes_in(const fs::path& folder) {
  std::vector<fs::path> out;
  std::error_code failed;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, failed), end;
  for (; !failed && at != end; at.increment(failed)) {
    const bool hidden = at->path().filename().string().starts_with('.');
    std::error_code unknown;
    if (at->is_directory(unknown)) {
      if (hidden || is_result(at->path())) at.disable_recursion_pending();
    } else if (!hidden && is_mesh(at->path())) {
      out.push_back(at->path());
    }
  }
  if (failed) throw Error(ErrorCode::bad_file, folder.string() + ": cannot be listed: " + failed.message());
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<fs::path> meshes_of_list(const fs::path& list) {
  if (is_mesh(list))
    throw Error(ErrorCode::bad_argument, list.string() + ": is a mesh; give a folder or a list, or use intarsia run");
  std::ifstream in(list);
  if (!in) throw Error(ErrorCode::bad_file, list.string() + ": cannot be read; give a folder or a list of meshes");
  std::vector<fs::path> out;
  std::string line;
  while (std::getline(in, line)) {
    if (line.find('\0') != std::string::npos)
      throw Error(ErrorCode::bad_file, list.string() + ": is no text; give a folder or a list of meshes, one a line");
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
    line.erase(0, line.find_first_not_of(" \t"));
    if (line.empty() || line.front() == '#') continue;
    const fs::path file(line);
    out.push_back(file.is_absolute() ? file : list.parent_path() / file);
  }
  return out;
}

// Summaries and records live beside the folders of the items.
bool is_reserved(const std::string& name) {
  return name.starts_with('.') || name.starts_with("summary.") || name == "failed.txt";
}

std::size_t number_in(const std::string& text) {
  std::size_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc() || end != text.data() + text.size())
    throw Error(ErrorCode::bad_argument, "'" + text + "' is no whole number; a shard is written 3/16");
  return n;
}

}  // namespace

std::vector<BatchItem> find_items(const fs::path& input) {
  std::error_code failed;
  if (!fs::exists(input, failed))
    throw Error(ErrorCode::bad_file, input.string() + ": there is no such file or folder");
  const fs::path base = fs::absolute(input);
  std::vector<fs::path> files = fs::is_directory(base) ? meshes_in(base) : meshes_of_list(base);
  if (files.empty())
    throw Error(ErrorCode::bad_file, input.string() + ": no meshes there (.ply .obj .stl .off); a list has one a line");
  std::vector<BatchItem> out;
  std::set<std::string> taken;
  for (const fs::path& file : files) {
    const fs::path path = file.lexically_normal();
    std::string name = path.stem().string();
    if (is_reserved(name)) name.insert(0, "mesh-");
    if (taken.contains(name)) name.insert(0, path.parent_path().filename().string() + "-");
    const std::string wanted = name;
    for (int i = 2; taken.contains(name); ++i) name = wanted + "-" + std::to_string(i);
    taken.insert(name);
    out.push_back({path, name});
  }
  return out;
}

Shard shard_of(const std::string& text) {
  Shard shard;
  if (!text.empty()) {
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos) throw Error(ErrorCode::bad_argument, "--shard " + text + ": write it like 3/16");
    shard = {number_in(text.substr(0, slash)), number_in(text.substr(slash + 1))};
  } else {
    const char *id = std::getenv("SLURM_ARRAY_TASK_ID"), *least = std::getenv("SLURM_ARRAY_TASK_MIN"),
               *count = std::getenv("SLURM_ARRAY_TASK_COUNT"), *step = std::getenv("SLURM_ARRAY_TASK_STEP");
    if (!id || !least || !count) return shard;
    shard = {(number_in(id) - number_in(least)) / std::max<std::size_t>(step ? number_in(step) : 1, 1) + 1,
             number_in(count)};
  }
  if (shard.index < 1 || shard.index > shard.count)
    throw Error(ErrorCode::bad_argument, "shard " + std::to_string(shard.index) + " of " + std::to_string(shard.count) +
                                             ": shards are counted from 1 to the number of shards");
  return shard;
}

std::vector<BatchItem> items_of_shard(const std::vector<BatchItem>& items, const Shard& shard) {
  std::vector<BatchItem> out;
  for (std::size_t i = shard.index - 1; i < items.size(); i += shard.count) out.push_back(items[i]);
  return out;
}

}  // namespace intarsia::tools
