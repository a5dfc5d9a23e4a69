// The program as users meet it: exit statuses, files, what happens to earlier results.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/io/read_mesh.h"
#include "tools/exit_code.h"

using namespace intarsia;
using namespace intarsia::tools;
namespace fs = std::filesystem;

namespace {

// A folder of its own for each test.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("intarsia-test-" + std::to_string(getpid()));
  Folder() {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  std::string operator/(const char* name) const { return (path / name).string(); }
};

pid_t start(const std::vector<std::string>& arguments, const std::string& log) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child != 0) return child;
  std::vector<char*> argv{const_cast<char*>(INTARSIA_PROGRAM)};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  if (!std::freopen(log.c_str(), "w", stderr) || !std::freopen("/dev/null", "w", stdout)) _exit(99);
  execv(INTARSIA_PROGRAM, argv.data());
  _exit(98);
}

int finish(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

int program(const std::vector<std::string>& arguments, const std::string& log = "/dev/null") {
  return finish(start(arguments, log));
}

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

nlohmann::json json_of(const std::string& path) { return nlohmann::json::parse(text_of(path)); }

}  // namespace

TEST_CASE("make, run and features work together; the input's faces come back in order") {
  const Folder dir;
  REQUIRE(program({"make", "part", "--triangles", "12000", "-o", dir / "part.ply", "-q"}) == kExitDone);
  REQUIRE(program({"run", dir / "part.ply", "-o", dir / "out", "-q", "--trace", dir / "trace.json"}) == kExitDone);
  for (const char* name : {"patches.ply", "layout.ply", "network.ply", "network.json", "report.json", "preview.png"})
    CHECK(fs::file_size(dir / "out" + "/" + name) > 0);
  const Soup input = read_mesh(Work(), dir / "part.ply"), patches = read_mesh(Work(), dir / "out/patches.ply");
  CHECK(input.corner == patches.corner);
  CHECK(input.x == patches.x);
  const Soup layout = read_mesh(Work(), dir / "out/layout.ply");
  CHECK(layout.vertex_count() >= input.vertex_count());
  CHECK(std::equal(input.x.begin(), input.x.end(), layout.x.begin()));

  const nlohmann::json report = json_of(dir / "out/report.json"), network = json_of(dir / "out/network.json");
  CHECK(report["valid"] == true);
  CHECK(report["counts"]["not_discs"] == 0);
  std::vector<std::string> stages;
  for (const auto& s : report["stages"]) stages.push_back(s["name"]);
  CHECK(stages == std::vector<std::string>{"read", "surface", "scale", "curvature", "ridges", "curves", "network",
                                           "patches", "layout", "write"});
  CHECK(network["patches"].size() == report["counts"]["patches"]);
  CHECK(network["arcs"].size() == report["counts"]["arcs"]);
  for (const auto& arc : network["arcs"])
    CHECK(arc["vertices"].front() == network["nodes"][arc["start"].get<int>()]["vertex"]);
  CHECK(json_of(dir / "trace.json")["traceEvents"].size() >= 10);

  REQUIRE(program({"features", dir / "part.ply", "-o", dir / "fields.ply", "-q", "--report", dir / "f.json"}) == 0);
  const std::string fields = text_of(dir / "fields.ply");
  const std::string order =
      "x y z nx ny nz omega_1 omega_2 omega_3 omega_4 omega_5 omega_6 kmax kmin tmax_x tmax_y "
      "tmax_z tmin_x tmin_y tmin_z emax emin scale fit_ring status";
  std::size_t at = 0;
  std::istringstream names(order);
  for (std::string name; names >> name;) {
    CAPTURE(name);
    at = fields.find(" " + name + "\n", at);
    REQUIRE(at != std::string::npos);
  }
  CHECK(json_of(dir / "f.json")["stages"].size() == 5);
}

TEST_CASE("every kind of failure has its exit status and leaves an earlier result alone") {
  const Folder dir;
  REQUIRE(program({"make", "cube", "--triangles", "1200", "-o", dir / "cube.ply", "-q"}) == kExitDone);
  REQUIRE(program({"run", dir / "cube.ply", "-o", dir / "out", "-q"}) == kExitDone);
  const std::string before = text_of(dir / "out/patches.ply");
  std::ofstream(dir / "out/mine.txt") << "kept";

  CHECK(program({"run", dir / "cube.ply"}) == kExitUsage);
  CHECK(program({"run", dir / "cube.ply", "-o", dir / "out", "--no-such-option"}) == kExitUsage);
  CHECK(program({"run", dir / "cube.ply", "-o", dir / "out", "--extend.cone", "500"}) == kExitUsage);
  CHECK(program({"run", dir / "cube.ply", "-o", dir / "out", "--patches", "many"}) == kExitUsage);
  CHECK(program({"run", dir / "missing.ply", "-o", dir / "out"}, dir / "log") == kExitUnreadable);
  CHECK(text_of(dir / "log").find("missing.ply") != std::string::npos);
  std::ofstream(dir / "fan.off") << "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n";
  CHECK(program({"run", dir / "fan.off", "-o", dir / "out", "--strict"}, dir / "log") == kExitRejected);
  CHECK(program({"run", dir / "cube.ply", "-o", dir / "cube.ply"}) == kExitWrite);
  CHECK(program({"run", dir / "cube.ply", "-o", dir / "no/such/folder"}) == kExitWrite);

  CHECK(text_of(dir / "out/patches.ply") == before);
  CHECK(program({"run", dir / "cube.ply", "-o", dir / "out", "-q", "--patches", "9"}) == kExitDone);
  CHECK(json_of(dir / "out/report.json")["counts"]["patches"] == 9);
  CHECK(text_of(dir / "out/mine.txt") == "kept");
}

TEST_CASE("an interrupt ends the run with status 130 and writes nothing") {
  const Folder dir;
  REQUIRE(program({"make", "head", "--triangles", "400000", "-o", dir / "head.ply", "-q"}) == kExitDone);
  const pid_t child = start({"run", dir / "head.ply", "-o", dir / "out"}, dir / "log");
  for (int i = 0; i < 600 && text_of(dir / "log").find("surface") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  CHECK(finish(child) == kExitInterrupted);
  int left = 0;
  for (const auto& entry : fs::directory_iterator(dir.path)) {
    const std::string name = entry.path().filename().string();
    if (name != "head.ply" && name != "log") ++left;
  }
  CHECK(left == 0);
}
