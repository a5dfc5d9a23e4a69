#include <cmath>
#include <numbers>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "engine/io/read_labels.h"
#include "engine/io/read_mesh.h"
#include "engine/io/write_ply.h"
#include "tests/support/shapes.h"
#include "tests/tools/program.h"
#include "tools/exit_code.h"

using namespace intarsia;
using namespace intarsia::tools;
using doctest::Approx;
using nlohmann::json;

namespace {

void write_mesh(const std::string& path, const Soup& soup, const std::vector<int>& label) {
  PlyFile ply;
  ply.element("vertex", soup.vertex_count()).xyz<double>(soup.x, soup.y, soup.z);
  auto& face = ply.element("face", soup.face_count());
  face.triangles(soup.corner);
  if (!label.empty()) face.column<std::int32_t>("patch", label);
  write_ply(Work(), path, ply);
}

// Sides of the cube [0, 3]^3 as labels with gaps and signs.
std::vector<int> side_labels(const Soup& soup) {
  std::vector<int> label;
  for (std::size_t f = 0; f < soup.face_count(); ++f) {
    Vec3 c = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) c += test::point(soup, soup.corner[3 * f + i]) / 9;
    c -= Vec3(.5, .5, .5);
    int axis = 0;
    c.cwiseAbs().maxCoeff(&axis);
    label.push_back((axis + 1) * (c[axis] > 0 ? 10 : -1));
  }
  return label;
}

test::ProgramResult eval(const test::ProgramFolder& dir, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "eval");
  return test::run_program(INTARSIA_PROGRAM, arguments, dir);
}

}  // namespace

TEST_CASE("eval judges a labelled cube: everything is rebuilt") {
  const test::ProgramFolder dir("eval");
  const Soup cube = test::scaled(test::cube(8), 3);
  const std::vector<int> label = side_labels(cube);
  write_mesh(dir / "cube.ply", cube, label);
  const auto done = eval(dir, {dir / "cube.ply", "-o", dir / "out", "--samples", "5000", "--loop-samples", "40"});
  REQUIRE(done.status == kExitDone);
  CHECK(done.out.find("transfinite") != std::string::npos);
  const json report = json::parse(test::file_text(dir / "out/eval.json"));
  CHECK(report["schema"] == "intarsia-eval");
  CHECK(report["patches"] == 6);
  CHECK(report["not_discs"] == 0);
  CHECK(report["diagonal"].get<double>() == Approx(3 * std::sqrt(3)));
  CHECK(report["compactness"]["median"].get<double>() == Approx(4 / std::numbers::pi));
  CHECK(report["settings"]["loop_samples"] == 40);
  for (const char* way : {"triangulated", "transfinite", "filled"}) {
    CHECK(report[way]["hausdorff"].get<double>() < 1e-9);
    CHECK(report[way]["absolute"]["rms"].get<double>() < 1e-8);
    CHECK(report[way]["failed"] == 0);
    const std::string file = dir / (std::string("out/recon-") + way + ".ply");
    const Soup rebuilt = read_mesh(Work(), file);
    CHECK(rebuilt.face_count() == report[way]["triangles"].get<Index>());
    CHECK(read_face_labels(Work(), file, "patch").size() == rebuilt.face_count());
    Real most = 0;
    for (Index v = 0; v < rebuilt.vertex_count(); ++v) most = std::max(most, test::point(rebuilt, v).maxCoeff());
    CHECK(most == Approx(3));
  }
  CHECK(read_mesh(Work(), dir / "out/deviation.ply").corner == cube.corner);
  CHECK(test::file_text(dir / "out/eval.png").substr(1, 3) == "PNG");

  // The same labels from a .seg file, on one thread.
  write_mesh(dir / "plain.ply", cube, {});
  {
    std::ofstream seg(dir / "cube.seg");
    for (const int l : label) seg << l << '\n';
  }
  const auto seg = eval(dir, {dir / "plain.ply", "--labels", dir / "cube.seg", "-o", dir / "seg", "--samples", "5000",
                              "--loop-samples", "40", "--json", "-t", "1"});
  REQUIRE(seg.status == kExitDone);
  const json same = json::parse(seg.out);
  for (const char* key : {"patches", "compactness", "triangulated", "transfinite", "filled", "patch_table"})
    CHECK(same[key] == report[key]);
}

TEST_CASE("eval adds its files to a folder of results") {
  const test::ProgramFolder dir("eval");
  REQUIRE(
      test::run_program(INTARSIA_PROGRAM, {"make", "part", "--triangles", "8000", "-o", dir / "mesh.ply", "-q"}, dir)
          .status == kExitDone);
  REQUIRE(
      test::run_program(INTARSIA_PROGRAM, {"run", dir / "mesh.ply", "-o", dir / "out", "-n", "20", "-q"}, dir).status ==
      kExitDone);
  const std::string before = test::file_text(dir / "out/network.json");
  const auto done = eval(dir, {dir / "out", "--samples", "20000", "--loop-samples", "60", "--area"});
  INFO(done.err);
  REQUIRE(done.status == kExitDone);
  CHECK(test::file_text(dir / "out/network.json") == before);
  const json report = json::parse(test::file_text(dir / "out/eval.json"));
  CHECK(report["patches"] == json::parse(test::file_text(dir / "out/report.json"))["counts"]["patches"]);
  for (const char* way : {"triangulated", "triangulated_area", "transfinite", "filled"}) {
    const json& r = report[way];
    CHECK(r["rms"].get<double>() > 0);
    CHECK(r["rms"].get<double>() < .05);
    CHECK(r["rms"] == std::max(r["forward"]["rms"], r["backward"]["rms"]));
    CHECK(r["absolute"]["rms"].get<double>() == Approx(r["rms"].get<double>() * report["diagonal"].get<double>()));
  }
  CHECK(report["filled"]["rms"].get<double>() < report["triangulated"]["rms"].get<double>());
  // The layout's own labels, as they come and smoothed, are much the same layout.
  for (const bool smooth : {false, true}) {
    std::vector<std::string> arguments{dir / "out/layout.ply", "-o", dir / "again", "--samples", "20000",
                                       "--loop-samples",        "60", "--json"};
    if (smooth) arguments.push_back("--smooth");
    const auto again = eval(dir, arguments);
    INFO(again.err);
    REQUIRE(again.status == kExitDone);
    const json other = json::parse(again.out);
    CHECK(other["patches"] == report["patches"]);
    CHECK(other["triangulated"]["rms"].get<double>() ==
          Approx(report["triangulated"]["rms"].get<double>()).epsilon(.5));
  }
}

TEST_CASE("eval says what is wrong and writes nothing") {
  const test::ProgramFolder dir("eval");
  const Soup cube = test::cube(3);
  write_mesh(dir / "plain.ply", cube, {});
  write_mesh(dir / "one.ply", cube, std::vector<int>(cube.face_count(), 5));
  std::filesystem::create_directories(dir / "empty");
  std::ofstream(dir / "short.seg") << "1\n2\n";
  const auto fails = [&](std::vector<std::string> arguments, int status, const std::string& word) {
    const auto done = eval(dir, std::move(arguments));
    CHECK(done.status == status);
    CHECK(done.out.empty());
    INFO(done.err);
    CHECK(done.err.find(word) != std::string::npos);
    CHECK(!std::filesystem::exists(dir / "out"));
  };
  fails({dir / "plain.ply"}, kExitUsage, "-o DIR");
  fails({dir / "plain.ply", "-o", dir / "out"}, kExitUnreadable, "patch");
  fails({dir / "plain.ply", "-o", dir / "out", "--labels", dir / "short.seg"}, kExitUnreadable, "short.seg");
  fails({dir / "one.ply", "-o", dir / "out"}, kExitRejected, "one patch");
  fails({dir / "empty"}, kExitUnreadable, "layout.ply");
  fails({dir / "missing.ply", "-o", dir / "out"}, kExitUnreadable, "missing.ply");
  CHECK(std::filesystem::is_empty(dir / "empty"));
  // A damaged network.
  std::filesystem::create_directories(dir / "bad");
  write_mesh(dir / "bad/patches.ply", cube, std::vector<int>(cube.face_count(), 0));
  write_mesh(dir / "bad/layout.ply", cube, std::vector<int>(cube.face_count(), 0));
  std::ofstream(dir / "bad/network.json") << "{\"schema\": \"intarsia-network\", \"version\": 1}";
  fails({dir / "bad"}, kExitUnreadable, "");
}
