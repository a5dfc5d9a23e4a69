// The directions that includes may take, and the size of files (CONTRIBUTING.md).
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace fs = std::filesystem;

namespace {

struct Source {
  std::string path;  // from the root, with slashes
  std::vector<std::string> includes;
  int lines = 0;
};

std::vector<Source> sources(const std::string& folder) {
  std::vector<Source> found;
  const fs::path root = INTARSIA_SOURCE_DIR;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    Source s;
    s.path = fs::relative(entry.path(), root).generic_string();
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line); ++s.lines)
      if (line.rfind("#include ", 0) == 0) {
        const std::size_t begin = line.find_first_of("\"<") + 1, end = line.find_last_of("\">");
        s.includes.push_back(line.substr(begin, end - begin));
      }
    found.push_back(s);
  }
  return found;
}

bool starts(const std::string& text, const std::string& prefix) { return text.rfind(prefix, 0) == 0; }

// "engine/data" of "engine/data/mesh.h".
std::string folder_of(const std::string& path) {
  const std::size_t first = path.find('/');
  return first == std::string::npos ? "" : path.substr(0, path.find('/', first + 1));
}

bool allowed_in_engine(const std::string& from, const std::string& to) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> rules = {
      {"engine/base", {"engine/base"}},
      {"engine/data", {"engine/base", "engine/data"}},
      {"engine/parallel", {"engine/base", "engine/data", "engine/parallel"}},
      {"engine/space", {"engine/base", "engine/data", "engine/parallel", "engine/space"}},
      {"engine/run", {"engine/base", "engine/data", "engine/parallel", "engine/io", "engine/run"}},
      {"engine/io", {"engine/base", "engine/data", "engine/parallel", "engine/io"}},
  };
  for (const auto& [folder, allowed] : rules)
    if (folder == from) return std::find(allowed.begin(), allowed.end(), to) != allowed.end();
  return false;
}

bool is_allowed(const std::string& path, const std::string& include) {
  const std::string from = folder_of(path), to = folder_of(include);
  const bool ours = starts(include, "engine/") || starts(include, "kernels/") || starts(include, "graph/") ||
                    starts(include, "tools/") || starts(include, "tests/") || starts(include, "perf/");
  if (!ours) return true;
  if (starts(path, "engine/")) return allowed_in_engine(from, to);
  if (starts(path, "kernels/"))
    return to == from || to == "engine/base" || to == "engine/data" || to == "engine/parallel" || to == "engine/space";
  if (starts(path, "graph/")) return starts(to, "engine/") || starts(to, "kernels/") || starts(include, "graph/");
  if (starts(path, "tools/")) return !starts(include, "tests/") && !starts(include, "perf/");
  return true;
}

}  // namespace

TEST_CASE("includes follow the ladder tools -> graph -> kernels -> engine, never sideways") {
  for (const char* folder : {"engine", "kernels", "graph", "tools"})
    for (const Source& s : sources(folder))
      for (const std::string& include : s.includes) {
        CAPTURE(s.path);
        CAPTURE(include);
        CHECK(is_allowed(s.path, include));
      }
}

TEST_CASE("each library is seen by the one folder that wraps it") {
  for (const char* folder : {"engine", "kernels", "graph", "tools"})
    for (const Source& s : sources(folder))
      for (const std::string& include : s.includes) {
        CAPTURE(s.path);
        CAPTURE(include);
        if (starts(include, "tbb/")) CHECK((starts(s.path, "engine/parallel/") || starts(s.path, "engine/run/")));
        if (starts(include, "OpenMesh/")) CHECK(starts(s.path, "engine/io/"));
        if (starts(include, "nanoflann")) CHECK(s.path == "engine/space/point_tree.cpp");
        if (include.ends_with(".hxx")) CHECK(starts(s.path, "tools/step/occt/"));  // OpenCASCADE
        if (starts(include, "spdlog/") || starts(include, "fmt/") || starts(include, "CLI/"))
          CHECK(starts(s.path, "tools/"));
        if (include == "iostream") CHECK(starts(s.path, "tools/"));
      }
}

TEST_CASE("no source file is longer than 400 lines") {
  for (const char* folder : {"engine", "kernels", "graph", "tools", "tests", "perf"})
    for (const Source& s : sources(folder)) {
      CAPTURE(s.path);
      CHECK(s.lines <= 400);
    }
}

// Two of them in one program would be one to the linker, which keeps the functions of either.
TEST_CASE("no two headers define a type of the same name in the same namespace") {
  const fs::path root = INTARSIA_SOURCE_DIR;
  const std::regex type("^(?:struct|class|enum class) (?:alignas\\(\\w+\\) )?(\\w+)(?: final)?(?: :[^;]*)? ?\\{.*");
  std::map<std::string, std::string> home;
  for (const char* folder : {"engine", "kernels", "graph", "tools"})
    for (const Source& s : sources(folder)) {
      if (!s.path.ends_with(".h")) continue;
      std::ifstream in(root / s.path);
      std::string within;
      for (std::string line; std::getline(in, line);) {
        if (starts(line, "namespace ")) within = line.substr(10, line.find('{') - 10);
        std::smatch found;
        if (!std::regex_match(line, found, type)) continue;
        const auto entry = home.emplace(within + found[1].str(), s.path);
        CAPTURE(entry.first->first);
        CAPTURE(s.path);
        CHECK_MESSAGE(entry.second, "also in ", entry.first->second);
      }
    }
  CHECK(home.size() > 300);
}

TEST_CASE("every kernel folder has its tests") {
  const fs::path root = INTARSIA_SOURCE_DIR;
  for (const auto& entry : fs::directory_iterator(root / "kernels")) {
    if (!entry.is_directory()) continue;
    CAPTURE(entry.path().filename().string());
    CHECK(fs::exists(root / "tests" / "kernels" / entry.path().filename()));
  }
}
