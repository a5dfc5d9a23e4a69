#include "engine/io/read_polylines.h"

#include <doctest/doctest.h>

#include "engine/base/error.h"

using namespace intarsia;

namespace {

std::string refusal(const char* name, const char* text) {
  try {
    read_polylines(Work(), name, text);
  } catch (const Error& e) {
    return e.code() == ErrorCode::bad_file ? e.what() : "another code";
  }
  return "";
}

}  // namespace

TEST_CASE("lines of an OBJ file, with what else may be in it") {
  const auto curves = read_polylines(Work(), "c.obj",
                                     "# drawn\no curve\nv 0 0 0\nv 1 0 0 1.0\r\nvn 0 0 1\nl 1 2\nv 1 2.5e0 0\n"
                                     "l 1/1 2/2 -1 1\nf 1 2 3\n");
  REQUIRE(curves.size() == 2);
  CHECK(curves[0] == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}});
  CHECK(curves[1] == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 2.5, 0}, {0, 0, 0}});
}

TEST_CASE("polylines as CGAL writes them") {
  const auto curves = read_polylines(Work(), "c.polylines.txt", "2 0 0 0 1 1 1\n\n3 0 0 0 0 1 0 0 2 0\n");
  REQUIRE(curves.size() == 2);
  CHECK(curves[1][2] == Vec3(0, 2, 0));
}

TEST_CASE("what is no curve is named with its line") {
  CHECK(refusal("c.obj", "v 0 0 0\nl 1\n").find("line 2 is a curve of fewer than two points") != std::string::npos);
  CHECK(refusal("c.obj", "v 0 0 0\nl 1 2\n").find("line 2 names vertex '2' of 1") != std::string::npos);
  CHECK(refusal("c.obj", "v 0 nan 0\n").find("line 1 lacks a coordinate") != std::string::npos);
  CHECK(refusal("c.obj", "v 0 0 0\n").find("has no lines") != std::string::npos);
  CHECK(refusal("c.txt", "999999999999 0 0 0\n").find("line 1") != std::string::npos);
  CHECK(refusal("c.txt", "2 0 0 0 1 1\n").find("line 1") != std::string::npos);
  CHECK(refusal("c.ply", "ply\n").find(".obj") != std::string::npos);
}
