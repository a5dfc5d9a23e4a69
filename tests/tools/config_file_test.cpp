// Options from files, and what is said about those that do not exist.
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"
#include "tools/exit_code.h"

using namespace intarsia::test;
using namespace intarsia::tools;
using nlohmann::json;

namespace {

ProgramResult intarsia_says(const ProgramFolder& dir, const std::vector<std::string>& arguments) {
  return run_program(INTARSIA_PROGRAM, arguments, dir);
}

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

}  // namespace

TEST_CASE("what --print-config prints makes the same run") {
  const ProgramFolder dir("config");
  REQUIRE(intarsia_says(dir, {"make", "part", "--triangles", "6000", "-o", dir / "part.ply", "-q"}).status == 0);
  for (const char* mode : {"robust", "paper"}) {
    CAPTURE(mode);
    const ProgramResult printed =
        intarsia_says(dir, {"run", "--mode", mode, "--patches", "20", "--scale.flat", "0.07", "--print-config"});
    REQUIRE(printed.status == kExitDone);
    CHECK(printed.out.find("[scale]") != std::string::npos);
    write(dir / "given.toml", printed.out);
    REQUIRE(intarsia_says(dir, {"run", dir / "part.ply", "-o", dir / "a", "-q", "--write", "none", "--mode", mode,
                                "--patches", "20", "--scale.flat", "0.07"})
                .status == kExitDone);
    REQUIRE(intarsia_says(dir, {"run", dir / "part.ply", "-o", dir / "b", "-q", "--write", "none", "--config",
                                dir / "given.toml"})
                .status == kExitDone);
    const json a = json::parse(file_text(dir / "a/report.json")), b = json::parse(file_text(dir / "b/report.json"));
    CHECK(a["hash"] == b["hash"]);
    CHECK(a["mode"] == b["mode"]);
    CHECK(b["options"]["scale.flat"]["value"] == 0.07);
    // printed again from the file: the same text
    CHECK(intarsia_says(dir, {"run", "--config", dir / "given.toml", "--print-config"}).out == printed.out);
  }
}

TEST_CASE("the command line comes before the file") {
  const ProgramFolder dir("config-order");
  write(dir / "o.toml", "# mine\npatches = 12\nstrict = true\nmin-feature = \"2%\"\n\n[extend]\ncone = 30\n");
  const std::string both =
      intarsia_says(dir, {"run", "--config", dir / "o.toml", "--patches", "9", "--print-config"}).out;
  CHECK(both.find("patches = 9\n") != std::string::npos);
  CHECK(both.find("strict = true\n") != std::string::npos);
  CHECK(both.find("min-feature = \"2%\"\n") != std::string::npos);
  CHECK(both.find("[extend]\ncone = 30.0\n") != std::string::npos);
}

TEST_CASE("what a file may not say") {
  const ProgramFolder dir("config-wrong");
  const auto run_with = [&](const std::string& text) {
    write(dir / "o.toml", text);
    return intarsia_says(dir, {"run", "--config", dir / "o.toml", "--print-config"});
  };
  ProgramResult r = run_with("pathces = 12\n");
  CHECK(r.status == kExitUsage);
  CHECK(r.err.find("'pathces'; did you mean 'patches'?") != std::string::npos);
  r = run_with("[extend]\ncone = 500\n");
  CHECK(r.status == kExitUsage);
  CHECK(r.err.find("extend.cone") != std::string::npos);
  CHECK(run_with("[scale]\nflat = much\n").status == kExitUsage);
  CHECK(intarsia_says(dir, {"run", "--config", dir / "none.toml", "--print-config"}).status == kExitUsage);
}

TEST_CASE("unknown options and commands are errors with a suggestion") {
  const ProgramFolder dir("suggestion");
  ProgramResult r = intarsia_says(dir, {"run", "a.ply", "-o", dir / "x", "--pathces", "9"});
  CHECK(r.status == kExitUsage);
  CHECK(r.err.find("Did you mean --patches?") != std::string::npos);
  r = intarsia_says(dir, {"run", "a.ply", "-o", dir / "x", "--max-spread=2"});
  CHECK(r.status == kExitUsage);
  CHECK(r.err.find("Did you mean --patches.max-spread?") != std::string::npos);
  r = intarsia_says(dir, {"rum", "a.ply"});
  CHECK(r.status == kExitUsage);
  CHECK(r.err.find("Did you mean run?") != std::string::npos);
}

TEST_CASE("a dry run says what would happen and writes nothing") {
  const ProgramFolder dir("dry");
  REQUIRE(intarsia_says(dir, {"make", "cube", "--triangles", "1200", "-o", dir / "cube.ply", "-q"}).status == 0);
  const ProgramResult r = intarsia_says(dir, {"run", dir / "cube.ply", "-o", dir / "out", "--dry-run"});
  CHECK(r.status == kExitDone);
  CHECK(r.out.find("1200 triangles") != std::string::npos);
  CHECK(!std::filesystem::exists(dir / "out"));
  CHECK(intarsia_says(dir, {"run", dir / "none.ply", "-o", dir / "out", "--dry-run"}).status == kExitUnreadable);
  CHECK(intarsia_says(dir, {"run", dir / "cube.ply", "-o", dir / "no/such/out", "--dry-run"}).status == kExitWrite);
  CHECK(intarsia_says(dir, {"run", dir / "cube.ply", "-o", dir / "out", "--dry-run", "--max-memory", "1M"}).status ==
        kExitLimit);
}

TEST_CASE("progress for programs: every line is JSON, and it ends at 1") {
  const ProgramFolder dir("progress");
  REQUIRE(intarsia_says(dir, {"make", "cube", "--triangles", "1200", "-o", dir / "cube.ply", "-q"}).status == 0);
  const ProgramResult r =
      intarsia_says(dir, {"run", dir / "cube.ply", "-o", dir / "out", "-q", "--progress", "json", "--write", "none"});
  REQUIRE(r.status == kExitDone);
  std::istringstream lines(r.err);
  double last = 0;
  int ended = 0;
  for (std::string line; std::getline(lines, line);) {
    const json event = json::parse(line);
    CHECK(event["overall"].get<double>() >= last);
    last = event["overall"];
    ended += event["event"] == "end" ? 1 : 0;
  }
  CHECK(last == doctest::Approx(1));
  CHECK(ended >= 10);
}
