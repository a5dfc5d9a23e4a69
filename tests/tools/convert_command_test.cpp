#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"
#include "tools/exit_code.h"
#include "tools/export/formats.h"

using namespace intarsia;
using namespace intarsia::tools;

TEST_CASE("run writes what --write names, and convert writes the same from the result") {
  const test::ProgramFolder dir("convert");
  const auto intarsia = [&](std::vector<std::string> arguments) {
    return test::run_program(INTARSIA_PROGRAM, arguments, dir);
  };
  REQUIRE(intarsia({"make", "part", "--triangles", "4000", "-o", dir / "part.ply", "-q"}).status == kExitDone);
  REQUIRE(intarsia({"run", dir / "part.ply", "-o", dir / "out", "-n", "12", "-q", "--write", "all"}).status ==
          kExitDone);
  for (const std::string& name : export_names()) {
    CAPTURE(name);
    CHECK(std::filesystem::file_size(dir / ("out/" + name)) > 0);
  }
  const auto done = intarsia({"convert", dir / "out", "-o", dir / "again", "--write", "all"});
  INFO(done.err);
  REQUIRE(done.status == kExitDone);
  for (const char* name : {"patches.vtp", "patches.obj", "patches.mtl", "network.obj", "labels.seg", "labels.npy",
                           "network.polylines.txt", "quadwild/layout.obj", "quadwild/layout.sharp",
                           "quadwild/layout.corners", "quadwild/layout.patch", "quadwild/layout.c_feature"}) {
    CAPTURE(name);
    CHECK(test::file_text(dir / (std::string("out/") + name)) == test::file_text(dir / (std::string("again/") + name)));
  }
  CHECK(!std::filesystem::exists(dir / "again/features.vtp"));

  // Into the result itself: nothing that was there goes.
  REQUIRE(intarsia({"run", dir / "part.ply", "-o", dir / "out", "-n", "12", "-q", "--write", "none"}).status ==
          kExitDone);
  for (const std::string& name : export_names()) CHECK(!std::filesystem::exists(dir / ("out/" + name)));
  const std::string network = test::file_text(dir / "out/network.json");
  REQUIRE(intarsia({"convert", dir / "out", "--write", "seg,layout.glb", "-q"}).status == kExitDone);
  CHECK(test::file_text(dir / "out/labels.seg") == test::file_text(dir / "again/labels.seg"));
  CHECK(std::filesystem::exists(dir / "out/layout.glb"));
  CHECK(test::file_text(dir / "out/network.json") == network);

  const auto wrong = intarsia({"run", dir / "part.ply", "-o", dir / "wrong", "--write", "vtp,sge"});
  CHECK(wrong.status == kExitUsage);
  CHECK(wrong.err.find("did you mean 'seg'") != std::string::npos);
  CHECK(!std::filesystem::exists(dir / "wrong"));
  CHECK(intarsia({"convert", dir / "out", "--write", "features.vtp"}).status == kExitUsage);
  CHECK(intarsia({"convert", dir / "part.ply", "--write", "seg"}).status == kExitUnreadable);
}
