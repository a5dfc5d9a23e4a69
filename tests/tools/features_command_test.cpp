#include <filesystem>

#include <doctest/doctest.h>

#include "engine/io/read_mesh.h"
#include "tests/tools/program.h"
#include "tools/exit_code.h"

using namespace intarsia;
using namespace intarsia::tools;

TEST_CASE("features draws the chosen rings, and refuses vertices that do not exist") {
  const test::ProgramFolder dir("features");
  const auto run = [&](const std::vector<std::string>& arguments) {
    return test::run_program(INTARSIA_PROGRAM, arguments, dir);
  };
  REQUIRE(run({"make", "star", "--triangles", "2000", "-o", dir / "star.ply", "-q"}).status == kExitDone);
  REQUIRE(run({"features", dir / "star.ply", "-o", dir / "fields.ply", "--picture", dir / "plain.png", "-q"}).status ==
          kExitDone);
  REQUIRE(run({"features", dir / "star.ply", "-o", dir / "fields.ply", "--picture", dir / "marked.png", "--vertices",
               "0,20,400", "-q"})
              .status == kExitDone);
  const std::string plain = test::file_text(dir / "plain.png"), marked = test::file_text(dir / "marked.png");
  CHECK(plain.substr(1, 3) == "PNG");
  CHECK(marked.substr(1, 3) == "PNG");
  CHECK(plain != marked);
  CHECK(read_mesh(Work(), dir / "fields.ply").corner == read_mesh(Work(), dir / "star.ply").corner);
  const auto wrong = run({"features", dir / "star.ply", "-o", dir / "none.ply", "--picture", dir / "none.png",
                          "--vertices", "99999999", "-q"});
  CHECK(wrong.status == kExitUsage);
  CHECK(wrong.err.find("99999999") != std::string::npos);
  CHECK(!std::filesystem::exists(dir / "none.ply"));
}

TEST_CASE("run writes the panels of its preview where it is told to") {
  const test::ProgramFolder dir("panels");
  const auto run = [&](const std::vector<std::string>& arguments) {
    return test::run_program(INTARSIA_PROGRAM, arguments, dir);
  };
  REQUIRE(run({"make", "cube", "--triangles", "1200", "-o", dir / "cube.ply", "-q"}).status == kExitDone);
  REQUIRE(run({"run", dir / "cube.ply", "-o", dir / "out", "--panels", dir / "panels", "-q"}).status == kExitDone);
  for (const char* name : {"input", "ridges-and-valleys", "filtered", "closed-network", "layout"})
    CHECK(std::filesystem::file_size(dir / ("panels/" + std::string(name) + ".png")) > 0);
  CHECK(!std::filesystem::exists(dir / "out/input.png"));
}
