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

test::ProgramResult seg_eval(const test::ProgramFolder& dir, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "seg-eval");
  return test::run_program(INTARSIA_PROGRAM, arguments, dir);
}

// Eight equal triangles in a row.
std::string strip() {
  std::ostringstream text;
  text << "OFF\n10 8 0\n";
  for (int i = 0; i < 5; ++i) text << i << " 0 0\n" << i << " 1 0\n";
  for (int i = 0; i < 4; ++i)
    text << "3 " << 2 * i << ' ' << 2 * i + 2 << ' ' << 2 * i + 1 << "\n3 " << 2 * i + 1 << ' ' << 2 * i + 2 << ' '
         << 2 * i + 3 << '\n';
  return text.str();
}

}  // namespace

TEST_CASE("seg-eval compares with each reference and averages") {
  const test::ProgramFolder dir("seg");
  std::ofstream(dir / "strip.off") << strip();
  std::ofstream(dir / "mine.seg") << "0\n0\n1\n1\n2\n2\n2\n2\n";
  std::ofstream(dir / "two.seg") << "5\n5\n5\n5\n3\n3\n3\n3\n";
  std::ofstream(dir / "one.seg") << "4\n4\n4\n4\n4\n4\n4\n4\n";
  const auto done = seg_eval(dir, {dir / "strip.off", "--labels", dir / "mine.seg", "--reference", dir / "two.seg",
                                   dir / "one.seg", dir / "mine.seg", "--json"});
  REQUIRE(done.status == kExitDone);
  const json report = json::parse(done.out), rows = report["references"];
  CHECK(report["segments"] == 3);
  REQUIRE(rows.size() == 3);
  CHECK(rows[0]["rand_error"].get<double>() == Approx(1.0 / 7));
  CHECK(rows[0]["missing_rate"].get<double>() == Approx(0.25));
  CHECK(rows[0]["false_alarm"] == 0);
  // Cuts at 1 and 2 against one at 2: a mean of 1/2 there, 0 back.
  CHECK(rows[0]["cut_discrepancy"].get<double>() > 0);
  CHECK(rows[1]["cut_discrepancy"].is_null());
  for (const char* name : {"cut_discrepancy", "hamming", "rand_error", "gce", "lce"}) CHECK(rows[2][name] == 0);
  CHECK(report["mean"]["missing_rate"].get<double>() == Approx((0.25 + rows[1]["missing_rate"].get<double>()) / 3));
  CHECK(report["mean"]["cut_discrepancy"].get<double>() == Approx(rows[0]["cut_discrepancy"].get<double>() / 2));
}

TEST_CASE("seg-eval finds the edges of a cube in its layout, and the layout's patches in its labels") {
  const test::ProgramFolder dir("seg");
  REQUIRE(
      test::run_program(INTARSIA_PROGRAM, {"make", "cube", "--triangles", "1200", "-o", dir / "cube.ply", "-q"}, dir)
          .status == kExitDone);
  REQUIRE(test::run_program(INTARSIA_PROGRAM, {"run", dir / "cube.ply", "-o", dir / "out", "-q"}, dir).status ==
          kExitDone);
  // The faces of the solid, by the direction that a triangle looks in.
  const Soup cube = read_mesh(Work(), dir / "cube.ply");
  std::ofstream seg(dir / "cube.seg");
  for (Index f = 0; f < cube.face_count(); ++f) {
    const auto point = [&](int i) {
      const Index v = cube.corner[3 * f + static_cast<Index>(i)];
      return Vec3(cube.x[v], cube.y[v], cube.z[v]);
    };
    const Vec3 n = (point(1) - point(0)).cross(point(2) - point(0));
    Eigen::Index axis = 0;
    n.cwiseAbs().maxCoeff(&axis);
    seg << 2 * axis + (n[axis] > 0 ? 1 : 0) << '\n';
  }
  seg.close();
  const auto done = seg_eval(dir, {dir / "cube.ply", "--layout", dir / "out", "--brep", dir / "cube.seg", "--reference",
                                   dir / "cube.seg", "--json"});
  REQUIRE(done.status == kExitDone);
  const json report = json::parse(done.out), brep = report["brep"];
  CHECK(brep["faces"] == 6);
  CHECK(brep["precision"].get<double>() > 0.98);
  CHECK(brep["recall"].get<double>() > 0.98);
  CHECK(brep["crease_recall"].get<double>() > 0.98);
  CHECK(report["mean"]["hamming"].get<double>() < 0.02);
  const auto text = seg_eval(dir, {dir / "cube.ply", "--labels", dir / "out/patches.ply", "--brep", dir / "cube.seg"});
  CHECK(text.status == kExitDone);
  CHECK(text.out.find("6 faces of the solid") != std::string::npos);
}

TEST_CASE("seg-eval names what is wrong") {
  const test::ProgramFolder dir("seg");
  std::ofstream(dir / "strip.off") << strip();
  std::ofstream(dir / "short.seg") << "0\n1\n";
  std::ofstream(dir / "good.seg") << "0\n0\n1\n1\n2\n2\n2\n2\n";
  CHECK(seg_eval(dir, {dir / "strip.off"}).status == kExitUsage);
  CHECK(seg_eval(dir, {dir / "strip.off", "--labels", dir / "good.seg"}).status == kExitUsage);
  const auto wrong = seg_eval(dir, {dir / "strip.off", "--labels", dir / "short.seg", "--reference", dir / "good.seg"});
  CHECK(wrong.status == kExitUnreadable);
  CHECK(wrong.err.find("short.seg") != std::string::npos);
  CHECK(seg_eval(dir, {dir / "strip.off", "--layout", dir / "none", "--reference", dir / "good.seg"}).status ==
        kExitUnreadable);
}
