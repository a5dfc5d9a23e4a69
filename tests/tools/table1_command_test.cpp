#include <cmath>
#include <map>
#include <sstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"
#include "tools/comparison.h"
#include "tools/exit_code.h"

using namespace intarsia;
using namespace intarsia::tools;
using doctest::Approx;
using nlohmann::json;

namespace {

std::vector<std::string> split(const std::string& line, char at) {
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

// Rows of a CSV file as column name -> cell.
std::vector<std::map<std::string, std::string>> csv_rows(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> column = split(line, ',');
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> cell = split(line, ',');
    REQUIRE(cell.size() == column.size());
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < column.size(); ++i) row[column[i]] = cell[i];
    rows.push_back(row);
  }
  return rows;
}

// Cells of the Markdown table row of a mesh and a method's name, without the blanks.
std::vector<std::string> markdown_row(const std::string& text, const std::string& mesh, const std::string& name) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> cell;
    for (const std::string& part : split(line, '|')) {
      const auto from = part.find_first_not_of(' ');
      cell.push_back(from == std::string::npos ? "" : part.substr(from, part.find_last_not_of(' ') + 1 - from));
    }
    if (cell.size() > 4 && cell[1] == mesh && cell[3] == name) return cell;
  }
  return {};
}

bool is_bold(const std::string& cell) { return cell.rfind("**", 0) == 0; }
double number(const std::string& cell) { return std::stod(is_bold(cell) ? cell.substr(2) : cell); }

// Methods with made-up numbers.
MethodNumbers made_up(const std::string& method, double rms, double q) {
  MethodNumbers m;
  m.method = m.name = method, m.patches = 4, m.q_median = q, m.q_high = 2 * q, m.q_most = 3 * q;
  m.triangulated = {true, 3 * rms, rms, rms / 2};
  m.filled = {true, 2 * rms, rms / 2, rms / 4};
  return m;
}

}  // namespace

TEST_CASE("table1 compares methods on two meshes; its files agree with each other") {
  const test::ProgramFolder dir("table1");
  const auto run = [&](const std::vector<std::string>& arguments) {
    return test::run_program(INTARSIA_PROGRAM, arguments, dir);
  };
  REQUIRE(run({"make", "part", "--triangles", "2500", "-o", dir / "part.ply", "-q"}).status == kExitDone);
  REQUIRE(run({"make", "star", "--triangles", "2500", "-o", dir / "star.ply", "-q"}).status == kExitDone);
  const auto done =
      run({"table1", dir / "part.ply", dir / "star.ply", "-o", dir / "out", "-n", "14", "--count", "star=10",
           "--methods", "vsa,faithful,exoskeleton", "--samples", "20000", "--loop-samples", "40", "--rebuilt"});
  INFO(done.err);
  REQUIRE(done.status == kExitDone);
  CHECK(done.out.find("ours, faithful") != std::string::npos);
  CHECK(test::file_text(dir / "out/table1.png").substr(1, 3) == "PNG");

  const json report = json::parse(test::file_text(dir / "out/table1.json"));
  const auto csv = csv_rows(test::file_text(dir / "out/table1.csv"));
  const std::string markdown = test::file_text(dir / "out/table1.md");
  REQUIRE(report["meshes"].size() == 2);
  REQUIRE(csv.size() == 6);
  std::size_t line = 0;
  for (const json& mesh : report["meshes"]) {
    const std::string name = mesh["mesh"];
    CAPTURE(name);
    const int wanted = name == "star" ? 10 : 14;
    CHECK(mesh["wanted_patches"] == wanted);
    REQUIRE(mesh["methods"].size() == 3);
    CHECK(mesh["methods"][0]["method"] == "vsa");  // in the order that was asked for
    CHECK(mesh["methods"][2]["method"] == "exoskeleton");
    const char* ways[] = {"triangulated", "transfinite", "filled"};
    const char* measures[] = {"hausdorff", "rms"};
    std::map<std::string, double> least;
    for (const json& m : mesh["methods"])
      for (const std::string way : ways)
        for (const std::string measure : measures) {
          const auto [at, fresh] = least.try_emplace(way + measure, m[way][measure]);
          at->second = std::min<double>(at->second, m[way][measure]);
        }
    for (const json& m : mesh["methods"]) {
      CAPTURE(m["method"].get<std::string>());
      CHECK(m["patches"] == wanted);
      const auto& row = csv[line++];
      CHECK(row.at("mesh") == name);
      CHECK(row.at("method") == m["method"]);
      CHECK(std::stoi(row.at("patches")) == wanted);
      CHECK(std::stod(row.at("q_median")) == Approx(m["q_median"].get<double>()));
      const std::vector<std::string> cells = markdown_row(markdown, name, m["name"]);
      REQUIRE(cells.size() > 12);
      CHECK(std::stoi(cells[4]) == wanted);
      std::size_t cell = 5;
      for (const std::string way : ways)
        for (const std::string measure : measures) {
          CAPTURE(way + " " + measure);
          const double value = m[way][measure], absolute = m[way][measure + "_absolute"];
          CHECK(value > 0);
          CHECK(absolute == Approx(value * mesh["diagonal"].get<double>()));
          CHECK(std::stod(row.at(way + "_" + measure)) == Approx(value).epsilon(1e-6));
          CHECK(std::stod(row.at(way + "_" + measure + "_absolute")) == Approx(absolute).epsilon(1e-6));
          CHECK(std::abs(number(cells[cell]) - 1e3 * value) < 0.0051);
          // Bold: the least of its column, and what is printed alike.
          if (value == least[way + measure]) CHECK(is_bold(cells[cell]));
          if (is_bold(cells[cell])) CHECK(1e3 * value < 1e3 * least[way + measure] + 0.011);
          ++cell;
        }
      CHECK(m["triangulated"]["rms"].get<double>() <= m["triangulated"]["hausdorff"].get<double>());
    }
  }

  // Means: products of the ratios, computed anew from the meshes.
  REQUIRE(report["means"].size() == 3);
  for (const json& mean : report["means"]) {
    CAPTURE(mean["name"].get<std::string>());
    CHECK(mean["meshes"] == 2);
    for (const std::string way : {"triangulated", "transfinite", "filled"})
      for (const std::string measure : {"hausdorff", "rms"}) {
        double product = 1;
        for (const json& mesh : report["meshes"]) {
          double own = 0, base = 0;
          for (const json& m : mesh["methods"]) {
            if (m["method"] == mean["method"]) own = m[way][measure];
            if (m["method"] == "vsa") base = m[way][measure];
          }
          product *= own / base;
        }
        CHECK(mean[way][measure].get<double>() == Approx(std::sqrt(product)));
        if (mean["method"] == "vsa") CHECK(mean[way][measure].get<double>() == Approx(1));
      }
  }
}

TEST_CASE("table1 measures against a reference and leaves that mesh out of the means") {
  const test::ProgramFolder dir("table1");
  const auto run = [&](const std::vector<std::string>& arguments) {
    return test::run_program(INTARSIA_PROGRAM, arguments, dir);
  };
  REQUIRE(run({"make", "cube", "--triangles", "700", "-o", dir / "cube.ply", "-q"}).status == kExitDone);
  REQUIRE(run({"make", "cube", "--triangles", "700", "-o", dir / "copy.ply", "-q"}).status == kExitDone);
  const auto done =
      run({"table1", dir / "cube.ply", dir / "copy.ply", "-o", dir / "out", "-n", "6", "--methods", "vsa", "--samples",
           "5000", "--loop-samples", "20", "--reference", "cube=" + (dir / "copy.ply"), "-q"});
  INFO(done.err);
  REQUIRE(done.status == kExitDone);
  CHECK(done.out.empty());
  const json report = json::parse(test::file_text(dir / "out/table1.json"));
  CHECK(report["meshes"][0]["reference"] == "copy");
  CHECK(report["meshes"][1]["reference"] == "");
  REQUIRE(report["means"].size() == 1);
  CHECK(report["means"][0]["meshes"] == 1);
  // Six squares: both are rebuilt exactly, and nothing is the better one for its rounding.
  for (const json& mesh : report["meshes"]) CHECK(mesh["methods"][0]["triangulated"]["rms"].get<double>() < 1e-9);
  CHECK(report["means"][0]["triangulated"]["rms"].get<double>() == Approx(1));
}

TEST_CASE("table1 refuses what it does not know and writes nothing") {
  const test::ProgramFolder dir("table1");
  REQUIRE(test::run_program(INTARSIA_PROGRAM, {"make", "cube", "--triangles", "700", "-o", dir / "cube.ply", "-q"}, dir)
              .status == kExitDone);
  const auto fails = [&](std::vector<std::string> arguments, int status, const std::string& word) {
    arguments.insert(arguments.begin(), {"table1", dir / "cube.ply", "-o", dir / "out"});
    const auto done = test::run_program(INTARSIA_PROGRAM, arguments, dir);
    INFO(done.err);
    CHECK(done.status == status);
    CHECK(done.out.empty());
    CHECK(done.err.find(word) != std::string::npos);
    CHECK(!std::filesystem::exists(dir / "out"));
  };
  fails({"--methods", "magic"}, kExitUsage, "magic");
  fails({"-n", "0"}, kExitUsage, "");
  fails({"--count", "cube"}, kExitUsage, "MESH=VALUE");
  fails({"--count", "cube=six"}, kExitUsage, "cube=six");
  fails({"--count", "ball=6"}, kExitUsage, "ball");
  fails({"--reference", "cube=" + (dir / "missing.ply"), "--methods", "vsa", "-n", "6"}, kExitUnreadable, "missing");
  fails({dir / "missing.ply", "--methods", "vsa", "-n", "6", "--samples", "2000"}, kExitUnreadable, "missing");
}

TEST_CASE("means are geometric, over the meshes that have both methods") {
  MeshNumbers a, b, against;
  a.mesh = "a", a.methods = {made_up("vsa", 1e-3, 1), made_up("x", 2e-3, 2)};
  b.mesh = "b", b.methods = {made_up("vsa", 1e-2, 4), made_up("x", 8e-2, 2)};
  against.mesh = "c", against.reference = "d", against.methods = {made_up("vsa", 1, 1), made_up("x", 100, 9)};
  b.methods[1].filled = {};  // not made: does not count
  const auto means = mean_ratios({a, b, against}, "vsa");
  REQUIRE(means.size() == 2);
  CHECK(means[0].rms[0] == Approx(1));
  CHECK(means[1].method == "x");
  CHECK(means[1].meshes == 2);
  CHECK(means[1].rms[0] == Approx(4));
  CHECK(means[1].hausdorff[0] == Approx(4));
  CHECK(means[1].worst_rms[0] == Approx(8));
  CHECK(means[1].rms[3] == Approx(2));
  CHECK(means[1].q_median == Approx(1));
  CHECK(mean_ratios({a}, "other").empty());
  CHECK(mean_ratios({}, "vsa").empty());
}
