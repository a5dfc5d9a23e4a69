// `intarsia info` and --max-memory as users meet them.
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"
#include "tools/forecast.h"

using namespace intarsia;
using test::ProgramFolder;
using test::run_program;

namespace {

// Two tetrahedra apart from each other, one triangle with a corner twice, one vertex of no triangle, and a third
// triangle on an edge of the first tetrahedron.
std::string write_odd_mesh(const ProgramFolder& folder) {
  const std::string path = folder / "odd.off";
  std::ofstream out(path);
  out << "OFF\n10 10 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n5 0 0\n6 0 0\n5 1 0\n5 0 1\n9 9 9\n0.5 -2 0\n"
         "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 4 6 5\n3 4 5 7\n3 5 6 7\n3 6 4 7\n3 4 4 5\n3 0 1 9\n";
  return path;
}

std::string make_ball(const ProgramFolder& folder) {
  const std::string path = folder / "part.ply";
  REQUIRE(run_program(INTARSIA_PROGRAM, {"make", "part", "-o", path, "--triangles", "40000"}, folder).status == 0);
  return path;
}

}  // namespace

TEST_CASE("info counts what a mesh holds and what is wrong with it") {
  const ProgramFolder folder("info");
  const auto result = run_program(INTARSIA_PROGRAM, {"info", "--json", write_odd_mesh(folder)}, folder);
  REQUIRE(result.status == 0);
  const nlohmann::json j = nlohmann::json::parse(result.out);
  CHECK(j["vertices"] == 10);
  CHECK(j["triangles"] == 10);
  CHECK(j["components"] == 2);
  CHECK(j["edges"] == 14);
  CHECK(j["faults"]["isolated_vertices"]["count"] == 1);
  CHECK(j["faults"]["repeated_corners"]["first"] == nlohmann::json{8});
  CHECK(j["border_edges"] == 2);
  CHECK(j["faults"]["non_manifold_edges"]["count"] == 1);
  CHECK(j["surface"] == false);
  CHECK(j["genus"].is_null());
  CHECK(j["refusal"].is_null());
  CHECK(j["mended"][0]["code"] == "cleaned-repeated-corners");
  CHECK(j["mended"][0]["count"] == 1);
  CHECK(j["noisy"] == false);
  CHECK(j["box"]["high"][0] == 6);
}

TEST_CASE("info tells people the same") {
  const ProgramFolder folder("info-text");
  const auto result = run_program(INTARSIA_PROGRAM, {"info", write_odd_mesh(folder)}, folder);
  REQUIRE(result.status == 0);
  for (const char* part :
       {"10 vertices", "2 components", "of 2 edges", "1 edges of three faces or more", "CPU seconds", "MB of memory"})
    CHECK_MESSAGE(result.out.find(part) != std::string::npos, part);
  CHECK(run_program(INTARSIA_PROGRAM, {"info", folder / "missing.ply"}, folder).status == 3);
}

TEST_CASE("forecasts grow with the mesh and never with fewer triangles") {
  for (const tools::CostModel& model : {tools::kRunCost, tools::kFeaturesCost}) {
    const tools::Forecast small = model(1000, 2000), large = model(1000000, 2000000), dense = model(1000, 9000);
    CHECK(small.cpu_seconds < large.cpu_seconds);
    CHECK(small.peak_memory < large.peak_memory);
    CHECK(small.peak_memory < dense.peak_memory);
  }
  CHECK(tools::memory_text(1650000000) == "1.65 GB");
  CHECK(tools::memory_text(250000000) == "250 MB");
}

TEST_CASE("a mesh that needs more than --max-memory is refused before any work, and one that needs less is not") {
  const ProgramFolder folder("max-memory");
  const std::string mesh = make_ball(folder), out = folder / "out";
  const auto run = [&](const std::string& most) {
    return run_program(INTARSIA_PROGRAM, {"run", mesh, "-o", out, "-q", "--max-memory", most}, folder);
  };
  const auto refused = run("20M");
  CHECK(refused.status == 6);
  for (const char* part : {"needs about", "21 MB", "--max-memory", "simplified"})
    CHECK_MESSAGE(refused.err.find(part) != std::string::npos, part);
  CHECK_FALSE(std::filesystem::exists(out));
  CHECK(run("4G").status == 0);
  CHECK(std::filesystem::exists(out + "/report.json"));
  CHECK(run("a lot").status == 2);
  CHECK(run("-1").status == 2);
  const auto features =
      run_program(INTARSIA_PROGRAM, {"features", mesh, "-o", folder / "f.ply", "--max-memory", "1M"}, folder);
  CHECK(features.status == 6);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(__clang__)
TEST_CASE("a run takes no more memory than was foretold, whether the mesh is small, a CAD part or a scan") {
  const ProgramFolder folder("foretold");
  for (const std::vector<std::string>& shape : {std::vector<std::string>{"cube", "--triangles", "600"},
                                                {"part", "--triangles", "20000", "--irregularity", "0.3"},
                                                {"head", "--triangles", "60000", "--noise-edges", "0.03"}}) {
    CAPTURE(shape[0]);
    std::vector<std::string> make = {"make", "-o", folder / "mesh.ply", "-q"};
    make.insert(make.begin() + 1, shape.begin(), shape.end());
    REQUIRE(run_program(INTARSIA_PROGRAM, make, folder).status == 0);
    const auto info = run_program(INTARSIA_PROGRAM, {"info", folder / "mesh.ply", "--json"}, folder);
    REQUIRE(run_program(INTARSIA_PROGRAM, {"run", folder / "mesh.ply", "-o", folder / "out", "-q", "-t", "2"}, folder)
                .status == 0);
    const auto report = nlohmann::json::parse(test::file_text(folder / "out/report.json"));
    CHECK(report["peak_memory_bytes"].get<double>() <=
          nlohmann::json::parse(info.out)["forecast"]["peak_memory_bytes"].get<double>());
  }
}
#endif

TEST_CASE("triangles that cross are named where that is asked for") {
  const ProgramFolder folder("crossing");
  std::ofstream(folder / "cross.off") << "OFF\n6 2 0\n0 0 0\n4 0 0\n0 4 0\n1 1 -1\n1 1 1\n9 9 0\n3 0 1 2\n3 3 4 5\n";
  const auto info = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"info", folder / "cross.off", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return nlohmann::json::parse(run_program(INTARSIA_PROGRAM, arguments, folder).out)["faults"];
  };
  CHECK(!info({}).contains("self_intersections"));
  const nlohmann::json found = info({"--self-intersections"})["self_intersections"];
  CHECK(found["pairs"] == 1);
  CHECK(found["count"] == 2);
  CHECK(found["first"] == std::vector<int>{0, 1});
}
