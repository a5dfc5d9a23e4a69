#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"
#include "tools/exit_code.h"

using namespace intarsia::test;
using namespace intarsia::tools;
using nlohmann::json;

namespace {

// A strip of 4 x 1 unit squares, two triangles each; square i has label of[i].
std::string strip(const std::vector<int>& of) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 10\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 8\nproperty list uchar int vertex_indices\nproperty int patch\nend_header\n";
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 2; ++j) text += std::to_string(i) + " " + std::to_string(j) + " 0\n";
  for (int i = 0; i < 4; ++i) {
    const std::string a = std::to_string(2 * i), b = std::to_string(2 * i + 1), c = std::to_string(2 * i + 2),
                      d = std::to_string(2 * i + 3), label = " " + std::to_string(of[i]) + "\n";
    text += "3 " + a + " " + c + " " + b + label + "3 " + b + " " + c + " " + d + label;
  }
  return text;
}

}  // namespace

TEST_CASE("compare: labels, best matches and distances of borders, with known answers") {
  const ProgramFolder dir("compare");
  std::ofstream(dir / "a.ply") << strip({0, 0, 1, 1});
  std::ofstream(dir / "b.ply") << strip({5, 2, 2, 2});
  ProgramResult r = run_program(INTARSIA_PROGRAM, {"compare", dir / "a.ply", dir / "b.ply", "--json"}, dir);
  REQUIRE(r.status == kExitDone);
  const json c = json::parse(r.out);
  CHECK(c["same_triangles"] == true);
  CHECK(c["identical_labels"] == false);
  CHECK(c["a"]["patches"] == 2);
  CHECK(c["a"]["border_length"].get<double>() == doctest::Approx(1));
  CHECK(c["a_to_b"]["largest"].get<double>() == doctest::Approx(1));  // x = 2 against x = 1
  CHECK(c["b_to_a"]["median"].get<double>() == doctest::Approx(1));
  CHECK(c["a_to_b"]["relative"]["mean"].get<double>() == doctest::Approx(1 / std::sqrt(17.0)));
  // a's left half: 1 of 2 squares with b's 5, 1 of 4 with b's 2; its right half: 2 of 3
  CHECK(c["patches"][0]["overlap"].get<double>() == doctest::Approx(0.5));
  CHECK(c["patches"][1]["overlap"].get<double>() == doctest::Approx(2.0 / 3));
  CHECK(run_program(INTARSIA_PROGRAM, {"compare", dir / "a.ply", dir / "b.ply", "--exact"}, dir).status ==
        kExitDegraded);
}

TEST_CASE("compare: a layout equals itself, and its mesh with labels") {
  const ProgramFolder dir("compare-same");
  REQUIRE(run_program(INTARSIA_PROGRAM, {"make", "cube", "--triangles", "1200", "-o", dir / "cube.ply", "-q"}, dir)
              .status == 0);
  for (const char* out : {"a", "b"})
    REQUIRE(run_program(INTARSIA_PROGRAM, {"run", dir / "cube.ply", "-o", dir / out, "-q", "--write", "none"}, dir)
                .status == 0);
  CHECK(run_program(INTARSIA_PROGRAM, {"compare", dir / "a", dir / "b", "--exact"}, dir).status == kExitDone);
  const ProgramResult r = run_program(INTARSIA_PROGRAM, {"compare", dir / "a", dir / "b/patches.ply", "--json"}, dir);
  REQUIRE(r.status == kExitDone);
  const json c = json::parse(r.out);
  CHECK(c["identical_labels"] == true);
  CHECK(c["labels"]["same_patches"] == 6);
  CHECK(c["a_to_b"]["largest"].get<double>() == doctest::Approx(0));
  CHECK(run_program(INTARSIA_PROGRAM, {"compare", dir / "a", dir / "none"}, dir).status == kExitUnreadable);
}
