// Every exit status of docs/formats.md, one by one, by what a user would do to meet it.
#include <chrono>
#include <csignal>
#include <thread>

#include <doctest/doctest.h>

#include "tests/tools/program.h"
#include "tools/exit_code.h"

using namespace intarsia::test;
using namespace intarsia::tools;

namespace {

struct Cube {
  ProgramFolder dir;
  explicit Cube(const std::string& name) : dir(name) {
    REQUIRE(says({"make", "cube", "--triangles", "1200", "-o", mesh(), "-q"}).status == kExitDone);
  }
  std::string mesh() const { return dir / "cube.ply"; }
  std::string out() const { return dir / "out"; }
  ProgramResult says(const std::vector<std::string>& arguments) const {
    return run_program(INTARSIA_PROGRAM, arguments, dir);
  }
  int run(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"run", mesh(), "-o", out(), "-q", "--write", "none"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return says(arguments).status;
  }
};

}  // namespace

TEST_CASE("0: done, also for help and version") {
  const Cube c("exit-0");
  CHECK(c.run({}) == 0);
  CHECK(c.says({"--help"}).status == 0);
  CHECK(c.says({"run", "--help"}).status == 0);
  CHECK(c.says({"--version"}).status == 0);
}

TEST_CASE("2: wrong usage") {
  const Cube c("exit-2");
  CHECK(c.says({}).status == 2);
  CHECK(c.says({}).err.find("Subcommands:") != std::string::npos);
  CHECK(c.says({"walk"}).status == 2);
  CHECK(c.says({"walk"}).err.find("'walk' is no command") != std::string::npos);
  CHECK(c.says({c.mesh()}).err.find("intarsia run") != std::string::npos);
  CHECK(c.run({"--patches", "-3"}) == 2);
  CHECK(c.run({"--patches", "9", "--tolerance", "1%"}) == 2);
  CHECK(c.run({"--tolerance", "thick"}) == 2);
  CHECK(c.run({"--progress", "dance"}) == 2);
  CHECK(c.run({"--write", "docx"}) == 2);
  CHECK(c.run({"--tolerance", "0"}) == 2);
  CHECK(c.run({"--threads", "99999"}) == 2);
  CHECK(c.run({"--network.snap", "half"}) == 2);
  CHECK(c.run({"--uneven.split", "maybe"}) == 2);
  CHECK(c.says({"make", "cube", "-o", c.dir / "cube.stl", "-q"}).status == 2);
  CHECK(c.says({"batch", c.mesh(), "-o", c.out()}).status == 2);
  const ProgramResult r = c.says({"run", c.mesh(), "-o", c.out(), "--patches", "-3"});
  CHECK(r.err.find("--patches: must be a whole number") != std::string::npos);
  CHECK(r.err.find("'-3'") != std::string::npos);
  CHECK(!std::filesystem::exists(c.out()));
}

TEST_CASE("3: input unreadable, whatever the input is for") {
  const Cube c("exit-3");
  std::ofstream(c.dir / "broken.ply") << "ply\nformat ascii 1.0\n";
  CHECK(c.says({"run", c.dir / "broken.ply", "-o", c.out()}).status == 3);
  CHECK(c.says({"info", c.dir / "none.ply"}).status == 3);
  CHECK(c.run({"--curves", c.dir / "none.obj"}) == 3);
  CHECK(c.run({"--pin", c.dir / "none.seg"}) == 3);
  std::ofstream(c.dir / "few.seg") << "0\n1\n";
  CHECK(c.run({"--pin", c.dir / "few.seg"}) == 3);
  CHECK(c.says({"eval", c.dir / "none"}).status == 3);
  CHECK(c.says({"view", c.mesh()}).status == 3);
}

TEST_CASE("4: input rejected") {
  const Cube c("exit-4");
  std::ofstream(c.dir / "fan.off") << "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n";
  CHECK(c.says({"run", c.dir / "fan.off", "-o", c.out(), "--strict"}).status == 4);
  std::ofstream(c.dir / "far.obj") << "v 0 0 0\nv 900 0 0\nl 1 2\n";
  const ProgramResult r = c.says({"run", c.mesh(), "-o", c.out(), "--curves", c.dir / "far.obj"});
  CHECK(r.status == 4);
  CHECK(r.err.find("same units") != std::string::npos);
}

TEST_CASE("5: what was promised does not hold") {
  const Cube c("exit-5");
  REQUIRE(c.run({}) == 0);
  REQUIRE(c.says({"run", c.mesh(), "-o", c.dir / "other", "-q", "--write", "none", "--patches", "9"}).status == 0);
  CHECK(c.says({"compare", c.out(), c.dir / "other"}).status == 0);
  CHECK(c.says({"compare", c.out(), c.dir / "other", "--exact"}).status == 5);
}

TEST_CASE("6: a limit of memory or time") {
  const Cube c("exit-6");
  CHECK(c.run({"--max-memory", "1M"}) == 6);
  CHECK(c.run({"--time-limit", "0.001s"}) == 6);
  CHECK(!std::filesystem::exists(c.out()));
}

TEST_CASE("7: output cannot be written") {
  const Cube c("exit-7");
  CHECK(c.says({"run", c.mesh(), "-o", c.mesh()}).status == 7);
  CHECK(c.says({"run", c.mesh(), "-o", c.dir / "no/such"}).status == 7);
  CHECK(c.says({"make", "cube", "-o", c.dir / "no/such.ply", "-q"}).status == 7);
}

TEST_CASE("8: some meshes of a batch failed") {
  const Cube c("exit-8");
  std::ofstream(c.dir / "list.txt") << c.mesh() << "\n"
                                    << c.dir / "none.ply"
                                    << "\n";
  CHECK(c.says({"batch", c.dir / "list.txt", "-o", c.out(), "-q", "--", "--write", "none"}).status == 8);
}

TEST_CASE("130: interrupted") {
  const Cube c("exit-130");
  REQUIRE(c.says({"make", "head", "--triangles", "200000", "-o", c.dir / "head.ply", "-q"}).status == 0);
  const std::string log = c.dir / "log";
  const pid_t child = start_program(INTARSIA_PROGRAM, {"run", c.dir / "head.ply", "-o", c.out(), "--progress", "json"},
                                    "/dev/null", log);
  for (int i = 0; i < 3000 && file_text(log).find("scale") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  CHECK(finish_program(child) == 130);
  CHECK(!std::filesystem::exists(c.out()));
}
