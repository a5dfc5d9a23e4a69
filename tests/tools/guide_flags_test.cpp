#include <set>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/support/shapes.h"
#include "tests/tools/program.h"
#include "tools/exit_code.h"

using namespace intarsia;
using namespace intarsia::tools;

TEST_CASE("--curves: what a hole interrupts and what was far away is said on the terminal and in the report") {
  const test::ProgramFolder dir("curves");
  const Soup plate = test::plane(24, 24);
  {
    std::ofstream mesh(dir / "plate.off");
    std::vector<Index> kept;  // the plate without a square in its middle
    for (Index f = 0; f < plate.face_count(); ++f) {
      Vec3 middle = Vec3::Zero();
      for (int i = 0; i < 3; ++i) middle += test::point(plate, plate.corner[3 * f + i]) / 3;
      if ((middle - Vec3(0.5, 0.5, 0)).cwiseAbs().maxCoeff() > 0.2) kept.push_back(f);
    }
    mesh << "OFF\n" << plate.vertex_count() << ' ' << kept.size() << " 0\n";
    for (Index v = 0; v < plate.vertex_count(); ++v)
      mesh << plate.x[v] << ' ' << plate.y[v] << ' ' << plate.z[v] << '\n';
    for (const Index f : kept)
      mesh << "3 " << plate.corner[3 * f] << ' ' << plate.corner[3 * f + 1] << ' ' << plate.corner[3 * f + 2] << '\n';
    std::ofstream(dir / "mine.obj") << "v 0.1 0.5 0.02\nv 0.9 0.5 0.02\nl 1 2\n";
    std::ofstream(dir / "near.obj") << "v 0.1 0.1 0\nv 0.9 0.1 0\nl 1 2\n";
  }
  const auto run = [&](const std::string& curves) {
    return test::run_program(INTARSIA_PROGRAM,
                             {"run", dir / "plate.off", "-o", dir / "out", "--write", "none", "--curves", dir / curves},
                             dir);
  };
  const auto codes = [&] {
    std::set<std::string> out;
    const nlohmann::json report = nlohmann::json::parse(test::file_text(dir / "out/report.json"));
    for (const auto& w : report["warnings"])
      if (w["code"].get<std::string>().rfind("curve-", 0) == 0) out.insert(w["code"].get<std::string>());
    return out;
  };
  const auto said = run("mine.obj");
  INFO(said.err);
  REQUIRE(std::filesystem::exists(dir / "out/report.json"));
  CHECK(codes() == std::set<std::string>{"curve-far", "curve-gap"});
  CHECK(said.err.find("begin anew behind it") != std::string::npos);
  CHECK(said.err.find("of the diagonal from the surface") != std::string::npos);
  CHECK(run("near.obj").err.find("warning: given curves") == std::string::npos);
  CHECK(codes().empty());
}
