#include <cmath>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "engine/io/read_mesh.h"
#include "tests/tools/program.h"
#include "tools/exit_code.h"

using namespace intarsia;
using namespace intarsia::tools;
using doctest::Approx;
using nlohmann::json;

namespace {

// A square of the given side and height, as OFF text.
std::string square(double side, double z, double offset = 0) {
  std::ostringstream text;
  text.precision(17);
  text << "OFF\n4 2 0\n";
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
    text << offset + side * (x - 0.5) << ' ' << offset + side * (y - 0.5) << ' ' << z << '\n';
  text << "3 0 1 2\n3 0 2 3\n";
  return text.str();
}

const char* kLabelled =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 2\nproperty list uchar int vertex_indices\nproperty int patch\nend_header\n"
    "-0.5 -0.5 0\n0.5 -0.5 0\n0.5 0.5 0\n-0.5 0.5 0\n3 0 1 2 7\n3 0 2 3 -1\n";

}  // namespace

TEST_CASE("distance prints both directions in the user's units and relative ones") {
  const test::ProgramFolder dir("distance");
  std::ofstream(dir / "a.off") << square(30, 1, 1e6);
  std::ofstream(dir / "b.off") << square(60, 1, 1e6);
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"distance", dir / "a.off", dir / "b.off", "--samples", "20000"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run_program(INTARSIA_PROGRAM, arguments, dir);
  };
  const auto text = run({});
  CHECK(text.status == kExitDone);
  CHECK(text.out.find("A to B") != std::string::npos);
  CHECK(text.err.empty());
  const json report = json::parse(run({"--json"}).out);
  const double diagonal = 30 * std::sqrt(2);
  CHECK(report["diagonal"].get<double>() == Approx(diagonal));
  CHECK(report["hausdorff"].get<double>() == Approx(15 * std::sqrt(2)));
  CHECK(report["relative"]["hausdorff"].get<double>() == Approx(0.5));
  CHECK(report["forward"]["max"].get<double>() < 1e-9);
  CHECK(report["backward"]["rms"].get<double>() == Approx(30 / std::sqrt(12)).epsilon(0.01));
  CHECK(report["backward"]["area"].get<double>() == Approx(3600));
  CHECK(std::abs(report["backward"]["worst"][0].get<double>() - 1e6) == Approx(30));
  const json one = json::parse(run({"--json", "-t", "1"}).out);
  for (const char* key : {"hausdorff", "mean", "rms", "relative", "forward", "backward"})
    CHECK(one[key] == report[key]);
}

TEST_CASE("distance writes a coloured mesh, a picture, samples, and a row per patch") {
  const test::ProgramFolder dir("distance");
  std::ofstream(dir / "a.ply") << kLabelled;
  std::ofstream(dir / "b.off") << square(1, 0.25);
  const auto done = test::run_program(INTARSIA_PROGRAM,
                                      {"distance", dir / "a.ply", dir / "b.off", "-o", dir / "out", "--samples", "2000",
                                       "--patches", "--save-samples", "csv"},
                                      dir);
  REQUIRE(done.status == kExitDone);
  const json report = json::parse(test::file_text(dir / "out/distance.json"));
  REQUIRE(report["patches"].size() == 2);
  CHECK(report["patches"][0]["patch"] == 7);
  CHECK(report["patches"][1]["patch"] == -1);
  for (const json& p : report["patches"]) {
    CHECK(p["rms"].get<double>() == Approx(0.25));
    CHECK(p["area"].get<double>() == Approx(0.5));
  }
  const Soup coloured = read_mesh(Work(), dir / "out/deviation.ply");
  CHECK(coloured.corner == read_mesh(Work(), dir / "a.ply").corner);
  const std::string ply = test::file_text(dir / "out/deviation.ply");
  for (const char* line : {"property uchar red", "property float distance\n", "property float distance_rms\n"})
    CHECK(ply.find(line) != std::string::npos);
  CHECK(test::file_text(dir / "out/deviation.png").substr(1, 3) == "PNG");
  std::istringstream csv(test::file_text(dir / "out/samples-a.csv"));
  std::string line;
  std::getline(csv, line);
  CHECK(line == "x,y,z,distance,triangle");
  std::size_t rows = 0;
  for (; std::getline(csv, line); ++rows) {
    std::array<double, 5> value{};
    std::istringstream cells(line);
    std::string cell;
    for (double& v : value) std::getline(cells, cell, ','), v = std::stod(cell);
    CHECK(value[2] == Approx(0));
    CHECK(value[3] == Approx(0.25));
    CHECK((value[4] == 0 ? value[1] <= value[0] + 1e-12 : value[1] >= value[0] - 1e-12));
  }
  CHECK(rows == report["forward"]["samples"].get<std::size_t>());
}

TEST_CASE("distance refuses what it cannot measure, each with its status") {
  const test::ProgramFolder dir("distance");
  std::ofstream(dir / "a.off") << square(1, 0);
  std::ofstream(dir / "line.off") << "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n";
  const auto status = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "distance");
    return test::run_program(INTARSIA_PROGRAM, arguments, dir).status;
  };
  CHECK(status({dir / "a.off"}) == kExitUsage);
  CHECK(status({dir / "a.off", dir / "none.off"}) == kExitUnreadable);
  CHECK(status({dir / "a.off", dir / "line.off"}) == kExitRejected);
  CHECK(status({dir / "a.off", dir / "a.off", "--patches"}) == kExitUnreadable);
  CHECK(status({dir / "a.off", dir / "a.off", "--save-samples", "ply"}) == kExitUsage);
  CHECK(status({dir / "a.off", dir / "a.off", "-o", dir / "missing/out"}) == kExitWrite);
}
