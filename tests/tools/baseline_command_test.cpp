#include <algorithm>
#include <filesystem>
#include <set>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "engine/io/read_labels.h"
#include "engine/io/read_mesh.h"
#include "tests/tools/program.h"
#include "tools/exit_code.h"

using namespace intarsia;
using namespace intarsia::tools;
using nlohmann::json;

TEST_CASE("baseline writes the files of a run for every method, at the wanted number of patches") {
  const test::ProgramFolder dir("baseline");
  const auto run = [&](const std::vector<std::string>& arguments) {
    return test::run_program(INTARSIA_PROGRAM, arguments, dir);
  };
  REQUIRE(run({"make", "part", "--triangles", "3000", "-o", dir / "part.ply", "-q"}).status == kExitDone);
  const Soup input = read_mesh(Work(), dir / "part.ply");
  for (const std::string method : {"vsa", "qse", "exoskeleton", "slippage"}) {
    CAPTURE(method);
    const auto done = run({"baseline", method, dir / "part.ply", "-o", dir / "out", "--patches", "12", "-q"});
    REQUIRE(done.status == kExitDone);
    for (const char* name : {"patches.ply", "layout.ply", "network.ply", "network.json", "report.json", "preview.png"})
      CHECK(std::filesystem::file_size(dir / "out" + "/" + name) > 0);
    const json report = json::parse(std::ifstream(dir / "out/report.json"));
    CHECK(report["command"] == "baseline");
    CHECK(report["counts"]["patches"] == 12);
    CHECK(report["counts"]["wanted_patches"] == 12);
    CHECK(report["valid"] == true);
    const std::string name = report["method"];
    CHECK((name.find("-like") != std::string::npos) == (method != "vsa"));
    const std::vector<int> label = read_face_labels(Work(), dir / "out/patches.ply", "patch");
    REQUIRE(label.size() == input.face_count());
    CHECK(std::set<int>(label.begin(), label.end()).size() == 12);
    CHECK(read_mesh(Work(), dir / "out/patches.ply").corner == input.corner);
  }
}

TEST_CASE("given parts bound the patches of the exoskeleton") {
  const test::ProgramFolder dir("baseline");
  const auto run = [&](const std::vector<std::string>& arguments) {
    return test::run_program(INTARSIA_PROGRAM, arguments, dir);
  };
  REQUIRE(run({"make", "cube", "--triangles", "1200", "-o", dir / "cube.ply", "-q"}).status == kExitDone);
  const Soup cube = read_mesh(Work(), dir / "cube.ply");
  const double middle =
      (*std::max_element(cube.z.begin(), cube.z.end()) + *std::min_element(cube.z.begin(), cube.z.end())) / 2;
  std::vector<int> part;
  std::ofstream seg(dir / "parts.seg");
  for (Index f = 0; f < cube.face_count(); ++f) {
    double z = 0;
    for (Index i = 0; i < 3; ++i) z += cube.z[cube.corner[3 * f + i]] / 3;
    part.push_back(z < middle ? 40 : -3);
    seg << part.back() << '\n';
  }
  seg.close();
  REQUIRE(run({"baseline", "exoskeleton", dir / "cube.ply", "-o", dir / "out", "-n", "10", "-q", "--parts",
               dir / "parts.seg"})
              .status == kExitDone);
  // The borders are smoothed: a face or two of a part's rim may end up across it.
  const std::vector<int> label = read_face_labels(Work(), dir / "out/patches.ply", "patch");
  std::vector<std::array<int, 2>> faces(10);
  for (std::size_t f = 0; f < label.size(); ++f) ++faces[static_cast<std::size_t>(label[f])][part[f] == 40 ? 0 : 1];
  int across = 0;
  for (const auto& [low, high] : faces) across += std::min(low, high);
  CHECK(across < 60);

  std::ofstream(dir / "short.seg") << "1\n2\n";
  const auto bad =
      run({"baseline", "exoskeleton", dir / "cube.ply", "-o", dir / "other", "--parts", dir / "short.seg"});
  CHECK(bad.status == kExitUnreadable);
  CHECK(bad.err.find("short.seg") != std::string::npos);
  CHECK(run({"baseline", "vsa", dir / "cube.ply", "-o", dir / "other", "--parts", dir / "parts.seg"}).status ==
        kExitUsage);
  CHECK(run({"baseline", "magic", dir / "cube.ply", "-o", dir / "other"}).status == kExitUsage);
  CHECK(run({"baseline", "vsa", dir / "cube.ply", "-o", dir / "other", "-n", "0"}).status == kExitUsage);
  CHECK(!std::filesystem::exists(dir / "other"));
}
