// Many meshes: one that fails stops no other, shards and interruptions add up
// to the whole.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <set>
#include <thread>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"
#include "tools/batch/find_items.h"
#include "tools/exit_code.h"

using namespace intarsia;
using namespace intarsia::tools;
using intarsia::test::file_text;
using intarsia::test::finish_program;
namespace fs = std::filesystem;

namespace {

struct Folder : test::ProgramFolder {
  Folder() : ProgramFolder("batch") {}
};

pid_t start(const std::vector<std::string>& arguments, const std::string& log = "/dev/null") {
  return test::start_program(INTARSIA_PROGRAM, arguments, "/dev/null", log);
}

int program(const std::vector<std::string>& arguments, const std::string& log = "/dev/null") {
  return finish_program(start(arguments, log));
}

nlohmann::json json_of(const std::string& path) { return nlohmann::json::parse(file_text(path)); }

// Three good meshes, one that is no mesh, one that is no surface.
void make_scans(const std::string& folder) {
  fs::create_directories(folder + "/deeper");
  REQUIRE(program({"make", "rounded-box", "--triangles", "4000", "-o", folder + "/box.ply", "-q"}) == 0);
  REQUIRE(program({"make", "torus", "--triangles", "3000", "-o", folder + "/ring.ply", "-q"}) == 0);
  REQUIRE(program({"make", "star", "--triangles", "5000", "-o", folder + "/deeper/box.ply", "-q"}) == 0);
  std::ofstream(folder + "/broken.stl") << "solid but not for long";
  std::ofstream(folder + "/empty.off") << "OFF\n0 0 0\n";
  std::ofstream(folder + "/readme.txt") << "no mesh";
}

std::string status_of(const nlohmann::json& summary, const std::string& name) {
  for (const auto& m : summary["meshes"])
    if (m["name"] == name) return m["status"];
  return "absent";
}

}  // namespace

TEST_CASE("a folder becomes items in order, each with a name of its own") {
  Folder folder;
  make_scans(folder / "scans");
  std::vector<std::string> names;
  for (const BatchItem& i : find_items(folder / "scans")) names.push_back(i.name);
  CHECK(names == std::vector<std::string>{"box", "broken", "deeper-box", "empty", "ring"});
  std::ofstream(folder / "list.txt") << "# two of them\n\n  scans/ring.ply \nscans/box.ply\r\nscans/box.ply\n";
  names.clear();
  for (const BatchItem& i : find_items(folder / "list.txt")) {
    names.push_back(i.name);
    CHECK(i.input.is_absolute());
  }
  CHECK(names == std::vector<std::string>{"ring", "box", "scans-box"});
  CHECK_THROWS(find_items(folder / "nothing"));
  std::ofstream(folder / "none.txt") << "# nothing\n";
  CHECK_THROWS(find_items(folder / "none.txt"));
  // Neither is a mesh a list, nor are the files of an earlier result meshes of the folder.
  CHECK_THROWS(find_items(folder / "scans/ring.ply"));
  fs::create_directories(folder / "scans/ring-out");
  for (const char* file : {"layout.ply", "patches.ply", "network.json"})
    std::ofstream(folder / (std::string("scans/ring-out/") + file));
  CHECK(find_items(folder / "scans").size() == 5);
}

TEST_CASE("shards: every item in exactly one; from the text or from Slurm") {
  std::vector<BatchItem> items(11);
  for (std::size_t i = 0; i < items.size(); ++i) items[i].name = std::to_string(i);
  std::multiset<std::string> seen;
  for (std::size_t i = 1; i <= 4; ++i)
    for (const BatchItem& item : items_of_shard(items, shard_of(std::to_string(i) + "/4"))) seen.insert(item.name);
  CHECK(seen.size() == 11);
  CHECK(std::set<std::string>(seen.begin(), seen.end()).size() == 11);
  for (const char* wrong : {"0/4", "5/4", "4", "a/4", "1/", "1/0", "-1/4"}) CHECK_THROWS(shard_of(wrong));
  setenv("SLURM_ARRAY_TASK_ID", "14", 1), setenv("SLURM_ARRAY_TASK_MIN", "10", 1);
  setenv("SLURM_ARRAY_TASK_STEP", "2", 1), setenv("SLURM_ARRAY_TASK_COUNT", "5", 1);
  const Shard slurm = shard_of("");
  CHECK(slurm.index == 3);
  CHECK(slurm.count == 5);
  for (const char* name : {"_ID", "_MIN", "_STEP", "_COUNT"})
    unsetenv(("SLURM_ARRAY_TASK" + std::string(name)).c_str());
  CHECK(shard_of("").count == 1);
}

TEST_CASE("bad meshes stop no others, the summary and the exit status tell") {
  Folder folder;
  make_scans(folder / "scans");
  CHECK(program({"batch", folder / "scans", "-o", folder / "out", "-q"}) == kExitBatch);
  const nlohmann::json summary = json_of(folder / "out/summary.json");
  CHECK(summary["counts"]["failed"] == 2);
  CHECK(summary["counts"]["missing"] == 0);
  CHECK(summary["meshes"].size() == 5);
  CHECK(status_of(summary, "broken") == "failed");
  CHECK(status_of(summary, "empty") == "failed");
  for (const auto& m : summary["meshes"]) {
    const std::string name = m["name"];
    if (m["status"] == "failed") {
      CHECK(!m["message"].get<std::string>().empty());
      CHECK(!fs::exists(folder / ("out/" + name)));
      continue;
    }
    const nlohmann::json report = json_of(folder / ("out/" + name + "/report.json"));
    CHECK(report["hash"] == m["hash"]);
    CHECK(report["counts"]["patches"] == m["patches"]);
  }
  const std::string failed = file_text(folder / "out/failed.txt");
  CHECK(std::count(failed.begin(), failed.end(), '\n') == 2);
  CHECK(failed.find("broken.stl") != std::string::npos);
  const std::string csv = file_text(folder / "out/summary.csv");
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 6);

  // Side by side or one after the other, alone or in a batch: the same layouts.
  CHECK(program({"batch", folder / "scans", "-o", folder / "one", "--jobs", "1", "-q"}) == kExitBatch);
  for (const auto& m : json_of(folder / "one/summary.json")["meshes"])
    for (const auto& n : summary["meshes"])
      if (n["name"] == m["name"]) CHECK(n["hash"] == m["hash"]);
}

TEST_CASE(
    "two shards, one of them killed, then resumed: complete, nothing "
    "done twice") {
  Folder folder;
  make_scans(folder / "scans");
  fs::remove(folder / "scans/broken.stl");
  fs::remove(folder / "scans/empty.off");
  CHECK(program({"batch", folder / "scans", "-o", folder / "out", "--shard", "2/2", "-q"}) == kExitDone);
  CHECK(json_of(folder / "out/summary.json")["counts"]["missing"] == 2);
  const pid_t shard =
      start({"batch", folder / "scans", "-o", folder / "out", "--shard", "1/2", "--jobs", "1", "-q"}, folder / "log");
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  kill(shard, SIGKILL);
  finish_program(shard);
  const auto before = fs::last_write_time(folder / "out/deeper-box/report.json");
  CHECK(program({"batch", folder / "scans", "-o", folder / "out", "--resume", "-q"}) == kExitDone);
  const nlohmann::json summary = json_of(folder / "out/summary.json");
  CHECK(summary["counts"]["done"] == 3);
  CHECK(fs::last_write_time(folder / "out/deeper-box/report.json") == before);

  // Other options or another file are not what was done.
  CHECK(program({"batch", folder / "scans", "-o", folder / "out", "--resume", "-q", "--", "--patches", "20"}) ==
        kExitDone);
  for (const auto& m : json_of(folder / "out/summary.json")["meshes"]) CHECK(m["patches"] == 20);
}

TEST_CASE(
    "options that run refuses end the batch at once; interrupts leave it "
    "resumable") {
  Folder folder;
  make_scans(folder / "scans");
  CHECK(program({"batch", folder / "scans", "-o", folder / "out", "-q", "--", "--patchez", "3"}, folder / "log") ==
        kExitUsage);
  CHECK(file_text(folder / "log").find("refused") != std::string::npos);
  CHECK(program({"batch", folder / "absent", "-o", folder / "out", "-q"}) == kExitUnreadable);
  CHECK(program({"batch", folder / "scans", "-o", folder / "out", "--shard", "3/2", "-q"}) == kExitUsage);
  fs::remove_all(folder / "out");
  const pid_t running = start({"batch", folder / "scans", "-o", folder / "out", "--jobs", "1", "-q"}, folder / "log");
  for (int i = 0; i < 6000 && !fs::exists(folder / "out/.batch"); ++i)  // a slow machine takes seconds to begin
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(running, SIGINT);
  const int exit = finish_program(running);
  CHECK((exit == kExitInterrupted || exit == kExitBatch));  // it may have been done by then
  CHECK(program({"batch", folder / "scans", "-o", folder / "out", "--resume", "-q"}) == kExitBatch);
  CHECK(json_of(folder / "out/summary.json")["counts"]["missing"] == 0);
}

TEST_CASE("a mesh that needs more memory than there is by forecast is not begun") {
  Folder folder;
  make_scans(folder / "scans");
  CHECK(program({"batch", folder / "scans", "-o", folder / "out", "--max-memory", "20M", "-q"}) == kExitBatch);
  for (const auto& m : json_of(folder / "out/summary.json")["meshes"]) CHECK(m["status"] == "failed");
}
