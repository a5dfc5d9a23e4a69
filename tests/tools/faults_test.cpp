// What the machine can do to a run: kill it, fill the disk, refuse memory, run out of time.
#include <chrono>
#include <csignal>
#include <functional>
#include <map>
#include <thread>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "tests/tools/program.h"
#include "tools/exit_code.h"

using namespace intarsia::test;
using namespace intarsia::tools;
namespace fs = std::filesystem;

namespace {

ProgramResult run(const std::vector<std::string>& arguments, const ProgramFolder& dir) {
  return run_program(INTARSIA_PROGRAM, arguments, dir);
}

// The same under limits that `limit` sets in the child.
ProgramResult run_limited(const std::vector<std::string>& arguments, const ProgramFolder& dir, int resource,
                          rlim_t most) {
  rlimit before{};
  getrlimit(resource, &before);
  rlimit limit = before;
  limit.rlim_cur = most;
  setrlimit(resource, &limit);
  const ProgramResult result = run(arguments, dir);
  setrlimit(resource, &before);
  return result;
}

bool says(const ProgramResult& r, const std::string& text) { return r.err.find(text) != std::string::npos; }

std::map<std::string, bool> restored_stages(const std::string& report) {
  std::map<std::string, bool> stages;
  const auto json = nlohmann::json::parse(file_text(report));
  for (const auto& s : json["stages"]) stages[s["name"]] = s.value("from_checkpoint", false);
  return stages;
}

void check_same(const std::string& a, const std::string& b) {
  for (const char* name : {"patches.ply", "layout.ply", "network.ply", "network.json", "preview.png"}) {
    CAPTURE(name);
    CHECK(file_text(a + "/" + name) == file_text(b + "/" + name));
  }
}

std::size_t hidden_entries(const std::string& folder) {
  std::size_t n = 0;
  for (const auto& entry : fs::directory_iterator(folder)) n += entry.path().filename().string()[0] == '.' ? 1 : 0;
  return n;
}

}  // namespace

TEST_CASE("a run resumes at the first stage that changed, and writes what a fresh one writes") {
  const ProgramFolder dir("resume");
  REQUIRE(run({"make", "part", "--triangles", "8000", "-o", dir / "part.ply", "-q"}, dir).status == 0);
  REQUIRE(run({"run", dir / "part.ply", "-o", dir / "fresh", "-q"}, dir).status == 0);
  const std::vector<std::string> kept = {"run",          dir / "part.ply", "-o", dir / "out",
                                         "--checkpoint", dir / "kept",     "-q"};
  REQUIRE(run(kept, dir).status == 0);
  check_same(dir / "fresh", dir / "out");

  REQUIRE(run(kept, dir).status == 0);
  check_same(dir / "fresh", dir / "out");
  for (const auto& [name, restored] : restored_stages(dir / "out/report.json"))
    CHECK(restored == (name != "read" && name != "write"));

  auto more = kept;
  more.insert(more.end(), {"--patches", "25"});
  REQUIRE(run(more, dir).status == 0);
  auto stages = restored_stages(dir / "out/report.json");
  CHECK((stages["surface"] && stages["scale"] && stages["curvature"] && stages["ridges"] && stages["curves"]));
  CHECK_FALSE((stages["network"] || stages["patches"] || stages["layout"]));
  REQUIRE(run({"run", dir / "part.ply", "-o", dir / "fresh", "--patches", "25", "-q"}, dir).status == 0);
  check_same(dir / "fresh", dir / "out");

  more.insert(more.end(), {"--smooth.iterations", "3"});
  REQUIRE(run(more, dir).status == 0);
  stages = restored_stages(dir / "out/report.json");
  CHECK((stages["network"] && stages["patches"]));
  CHECK_FALSE(stages["layout"]);

  // The fields are those of the run; a mesh that differs in one number has none of them.
  REQUIRE(run({"features", dir / "part.ply", "-o", dir / "f.ply", "--checkpoint", dir / "kept", "-q"}, dir).status ==
          0);
  std::string bytes = file_text(dir / "part.ply");
  bytes[bytes.find("end_header\n") + 13] ^= 1;
  std::ofstream(dir / "part.ply", std::ios::binary) << bytes;
  REQUIRE(run(kept, dir).status == 0);
  for (const auto& [name, restored] : restored_stages(dir / "out/report.json")) CHECK_FALSE(restored);
}

TEST_CASE("a killed run leaves the earlier result, and what it has done") {
  const ProgramFolder dir("killed");
  REQUIRE(run({"make", "part", "--triangles", "30000", "-o", dir / "part.ply", "-q"}, dir).status == 0);
  const std::vector<std::string> arguments = {"run", dir / "part.ply", "-o", dir / "out", "--checkpoint", dir / "kept"};
  const pid_t child = start_program(INTARSIA_PROGRAM, arguments, dir / "log", dir / "log");
  for (int i = 0; i < 3000 && !fs::exists(dir / "kept/curvature.stage"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(child, SIGKILL);
  CHECK(finish_program(child) == -SIGKILL);
  CHECK_FALSE(fs::exists(dir / "out"));
  REQUIRE(run(arguments, dir).status == 0);
  // Curvature is two nodes, and the kill may come between them.
  CHECK(restored_stages(dir / "out/report.json")["scale"]);
  REQUIRE(run({"run", dir / "part.ply", "-o", dir / "fresh", "-q"}, dir).status == 0);
  check_same(dir / "fresh", dir / "out");
  CHECK(hidden_entries(dir / "") == 0);
  CHECK(hidden_entries(dir / "kept") == 0);
}

TEST_CASE("a file that grows too large, and a folder that is missing: status 7, the earlier result stays") {
  const ProgramFolder dir("full");
  REQUIRE(run({"make", "part", "--triangles", "8000", "-o", dir / "part.ply", "-q"}, dir).status == 0);
  REQUIRE(run({"run", dir / "part.ply", "-o", dir / "out", "-q"}, dir).status == 0);
  const std::string before = file_text(dir / "out/report.json");
  const ProgramResult full =
      run_limited({"run", dir / "part.ply", "-o", dir / "out", "-q", "--patches", "20"}, dir, RLIMIT_FSIZE, 30'000);
  CHECK(full.status == kExitWrite);
  CHECK(says(full, "cannot be written"));
  CHECK(file_text(dir / "out/report.json") == before);
  CHECK(hidden_entries(dir / "") == 0);
  // Checkpoints that do not fit cost a warning, not the result.
  const ProgramResult warned = run_limited({"run", dir / "part.ply", "-o", dir / "out", "--checkpoint", dir / "kept"},
                                           dir, RLIMIT_FSIZE, 600'000);
  CHECK(warned.status == kExitDone);
  CHECK(says(warned, "no checkpoint"));
  CHECK(hidden_entries(dir / "kept") == 0);
  CHECK(run({"run", dir / "part.ply", "-o", dir / "out", "--checkpoint", dir / "part.ply"}, dir).status == kExitWrite);
  CHECK(run({"run", dir / "part.ply", "-o", dir / "out", "--checkpoint", dir / "no/such"}, dir).status == kExitWrite);
}

TEST_CASE("memory that the system refuses: status 6 and a reason, nothing written" *
          doctest::skip(std::getenv("ASAN_OPTIONS") != nullptr)) {
  const ProgramFolder dir("memory");
  REQUIRE(run({"make", "sphere", "--triangles", "300000", "-o", dir / "s.ply", "-q"}, dir).status == 0);
  const ProgramResult r =
      run_limited({"run", dir / "s.ply", "-o", dir / "out", "-q", "-t", "1"}, dir, RLIMIT_AS, 160'000'000);
  CHECK(r.status == kExitLimit);
  CHECK(says(r, "memory"));
  CHECK_FALSE(fs::exists(dir / "out"));
}

TEST_CASE("a time limit: status 6, and nothing where there was no time for anything") {
  const ProgramFolder dir("time");
  REQUIRE(run({"make", "part", "--triangles", "8000", "-o", dir / "part.ply", "-q"}, dir).status == 0);
  const ProgramResult none = run({"run", dir / "part.ply", "-o", dir / "out", "--time-limit", "0.001s"}, dir);
  CHECK(none.status == kExitLimit);
  CHECK(says(none, "time limit"));
  CHECK_FALSE(fs::exists(dir / "out"));
  CHECK(run({"run", dir / "part.ply", "-o", dir / "out", "--time-limit", "2h", "-q"}, dir).status == kExitDone);
  CHECK(nlohmann::json::parse(file_text(dir / "out/report.json"))["time_limit"]["shortened"] == false);
  for (const char* bad : {"0", "-3", "soon", "10x"})
    CHECK(run({"run", dir / "part.ply", "-o", dir / "out", "--time-limit", bad}, dir).status == kExitUsage);
}

TEST_CASE("results that standard output does not take: status 7") {
  const ProgramFolder dir("stdout");
  REQUIRE(run({"make", "cube", "--triangles", "500", "-o", dir / "c.ply", "-q"}, dir).status == 0);
  const pid_t child = start_program(INTARSIA_PROGRAM, {"info", dir / "c.ply", "--json"}, "/dev/full", dir / "log");
  CHECK(finish_program(child) == kExitWrite);
}
