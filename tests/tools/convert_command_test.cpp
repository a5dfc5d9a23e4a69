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
  REQUIRE(intarsia({"make", "head", "--triangles", "12000", "-o", dir / "part.ply", "-q"}).status == kExitDone);
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

TEST_CASE("view finds the page, render draws without a display, eval adds the deviation to the page") {
  const test::ProgramFolder dir("view");
  const auto intarsia = [&](std::vector<std::string> arguments) {
    return test::run_program(INTARSIA_PROGRAM, arguments, dir);
  };
  REQUIRE(intarsia({"make", "cube", "--triangles", "1200", "-o", dir / "cube.ply", "-q"}).status == kExitDone);
  REQUIRE(intarsia({"run", dir / "cube.ply", "-o", dir / "out", "-q"}).status == kExitDone);
  const auto page = intarsia({"view", dir / "out", "--print"});
  CHECK(page.status == kExitDone);
  REQUIRE(!page.out.empty());
  CHECK(std::filesystem::equivalent(page.out.substr(0, page.out.size() - 1), dir / "out/view.html"));
  const std::string before = test::file_text(dir / "out/view.html");
  CHECK(before.find("\"name\":\"cube.ply\"") != std::string::npos);
  CHECK(before.find("\"deviation\":") == std::string::npos);
  REQUIRE(intarsia({"eval", dir / "out", "-q", "--samples", "4000", "--loop-samples", "30"}).status == kExitDone);
  const std::string after = test::file_text(dir / "out/view.html");
  CHECK(after.find("\"deviation\":") != std::string::npos);
  REQUIRE(intarsia({"convert", dir / "out", "--write", "html", "-q"}).status == kExitDone);
  CHECK(test::file_text(dir / "out/view.html") == after);  // nothing that only run and eval know is lost

  const auto missing = intarsia({"view", dir / ""});
  CHECK(missing.status == kExitUnreadable);
  CHECK(missing.err.find("convert") != std::string::npos);

  for (const char* stage : {"input", "raw", "filtered", "network", "patches", "deviation"}) {
    CAPTURE(stage);
    const std::string file = dir / (std::string(stage) + ".png");
    REQUIRE(intarsia({"render", dir / "out", "-o", file, "--size", "160x120", "--stage", stage, "--camera", "1,2,3",
                      "--samples", "1"})
                .status == kExitDone);
    const std::string png = test::file_text(file);
    REQUIRE(png.size() > 100);
    CHECK(png.substr(16, 8) == std::string("\0\0\0\xa0\0\0\0\x78", 8));
  }
  CHECK(test::file_text(dir / "input.png") != test::file_text(dir / "network.png"));
  CHECK(test::file_text(dir / "network.png") != test::file_text(dir / "patches.png"));
  CHECK(test::file_text(dir / "raw.png") != test::file_text(dir / "input.png"));
  CHECK(test::file_text(dir / "filtered.png") != test::file_text(dir / "input.png"));
  CHECK(test::file_text(dir / "deviation.png") != test::file_text(dir / "network.png"));
  // A picture with the scale of its colours has the size asked for too.
  REQUIRE(intarsia({"render", dir / "out", "-o", dir / "scale.png", "--size", "320x300", "--stage", "deviation",
                    "--samples", "1"})
              .status == kExitDone);
  CHECK(test::file_text(dir / "scale.png").substr(16, 8) == std::string("\0\0\x01\x40\0\0\x01\x2c", 8));
  // What a stage is drawn from may not be there: the message says which command makes it.
  std::filesystem::remove(dir / "out/view.html"), std::filesystem::remove(dir / "out/deviation.ply");
  for (const auto& [stage, command] : {std::pair<const char*, const char*>{"raw", "--write html"},
                                       {"filtered", "--write html"},
                                       {"deviation", "intarsia eval"}}) {
    CAPTURE(stage);
    const auto absent = intarsia({"render", dir / "out", "-o", dir / "absent.png", "--stage", stage});
    CHECK(absent.status == kExitUnreadable);
    CHECK(absent.err.find(command) != std::string::npos);
    CHECK(!std::filesystem::exists(dir / "absent.png"));
  }
  for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{{"--size", "160"},
                                                                                     {"--camera", "1,2"},
                                                                                     {"--camera", "0,0,0"},
                                                                                     {"--camera", "0,1,0,0,2,0"},
                                                                                     {"--stage", "x"}}) {
    std::vector<std::string> arguments = {"render", dir / "out", "-o", dir / "wrong.png"};
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    CAPTURE(wrong.back());
    CHECK(intarsia(arguments).status == kExitUsage);
    CHECK(!std::filesystem::exists(dir / "wrong.png"));
  }
}
