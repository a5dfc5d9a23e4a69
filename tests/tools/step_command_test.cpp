#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"
#include "tools/exit_code.h"
#include "tools/step/cad_shape.h"

using namespace intarsia;
using namespace intarsia::tools;

TEST_CASE("step: without OpenCASCADE it says what to install, with it the layout becomes a solid") {
  const test::ProgramFolder dir("step");
  const auto intarsia = [&](std::vector<std::string> arguments) {
    return test::run_program(INTARSIA_PROGRAM, arguments, dir);
  };
  REQUIRE(intarsia({"make", "rounded-box", "--triangles", "6000", "-o", dir / "box.ply", "-q"}).status == kExitDone);
  REQUIRE(intarsia({"run", dir / "box.ply", "-o", dir / "out", "-q", "--write", "none"}).status == kExitDone);
  const auto done = intarsia({"step", dir / "out", "-o", dir / "box.step", "-t", "2", "--tolerance", "0.5%"});
  INFO(done.err);
#ifndef INTARSIA_HAS_OPENCASCADE
  MESSAGE("OpenCASCADE is not installed (tools/setup --step): skipped");
  CHECK(done.status == kExitUsage);
  CHECK(done.err.find("libocct-data-exchange-dev") != std::string::npos);
  CHECK(!std::filesystem::exists(dir / "box.step"));
#else
  REQUIRE(done.status == kExitDone);
  const nlohmann::json report = nlohmann::json::parse(test::file_text(dir / "box.step.json"));
  CHECK(report["valid"] == true);
  CHECK(report["free_edges"] == 0);
  CHECK(report["solids"] == 1);
  CHECK(report["shells"] == 1);
  CHECK(report["faces"] == report["patches"]);
  CHECK(report["face_table"].size() == report["patches"]);
  CHECK(report["deviation"]["largest"]["percent"].get<double>() <= 0.5);
  const double tolerance = report["tolerance"]["absolute"], area = report["area"];
  CHECK(std::abs(report["volume"].get<double>() - report["mesh_volume"].get<double>()) <= tolerance * area);
  for (const auto& row : report["face_table"]) CHECK(row["within"] == true);
  const auto& again = report["read_back"];
  CHECK(again["valid"] == true);
  CHECK(again["faces"] == report["faces"]);
  CHECK(again["edges"] == report["edges"]);
  CHECK(again["free_edges"] == 0);
  CHECK(again["degenerate_edges"] == 0);
  CHECK(again["mesh_to_faces"]["percent"].get<double>() <= 0.5);
  CHECK(again["faces_to_mesh"]["percent"].get<double>() <= 0.5);

  const std::string text = test::file_text(dir / "box.step");
  CHECK(text.rfind("ISO-10303-21;", 0) == 0);
  CHECK(text.find("B_SPLINE_SURFACE") != std::string::npos);

  // Another program's view of the file: the library's reader.
  const CadShape read = CadShape::read_step(dir / "box.step");
  const CadCheck check = read.check();
  INFO(check.trouble);
  CHECK(check.valid);
  CHECK(check.faces == report["faces"].get<Index>());
  CHECK(check.solids == 1);
  CHECK(check.free_edges == 0);
  CHECK(check.volume == doctest::Approx(report["volume"].get<double>()).epsilon(1e-4));

  // The same bytes with one thread; another unit is another name, the numbers stay.
  std::filesystem::create_directory(dir / "again");
  REQUIRE(
      intarsia({"step", dir / "out", "-o", dir / "again/box.step", "-t", "1", "-q", "--tolerance", "0.5%"}).status ==
      kExitDone);
  CHECK(test::file_text(dir / "again/box.step") == text);
  REQUIRE(intarsia({"step", dir / "out", "-o", dir / "again/box.step", "--unit", "m", "-q", "--tolerance", "0.5%"})
              .status == kExitDone);
  const std::string metres = test::file_text(dir / "again/box.step");
  CHECK(text.find("SI_UNIT(.MILLI.,.METRE.)") != std::string::npos);
  CHECK(metres.find("SI_UNIT($,.METRE.)") != std::string::npos);
  const auto first_coordinate = [](const std::string& t) {
    const std::size_t point = t.find("CARTESIAN_POINT('',(", t.find("VERTEX_POINT"));
    return std::stod(t.substr(point + 20));
  };
  CHECK(first_coordinate(text) == doctest::Approx(first_coordinate(metres)).epsilon(1e-9));

  CHECK(intarsia({"step", dir / "out", "--tolerance", "50%"}).status == kExitUsage);
  CHECK(intarsia({"step", dir / "box.ply"}).status == kExitUnreadable);
  CHECK(intarsia({"step", dir / "out", "--unit", "mile"}).status == kExitUsage);
#endif
}
