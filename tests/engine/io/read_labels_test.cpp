#include "engine/io/read_labels.h"

#include <doctest/doctest.h>

#include "engine/io/read_mesh.h"
#include "tests/engine/io/io_support.h"
#include "tests/engine/io/ply_builder.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

// Two triangles and a quad, labelled 7, -2, 7, with other properties and a list element around them.
std::string labelled(const std::string& format, const std::string& type) {
  PlyBuilder ply(format);
  ply.line("element vertex 5").line("property float x").line("property float y").line("property float z");
  ply.line("element note 2").line("property list uchar short words");
  ply.line("element face 3").line("property uchar red").line("property list uchar int vertex_indices");
  ply.line("property " + type + " patch").line("property float quality").line("end_header");
  for (int v = 0; v < 5; ++v) ply.put("float", v % 2).put("float", v / 2).put("float", 0.5).item();
  for (int n = 0; n < 2; ++n) ply.put("uchar", 2).put("short", 1).put("short", -1).item();
  const std::vector<std::vector<int>> face = {{0, 1, 2}, {1, 3, 2}, {2, 3, 4, 1}};
  const int label[] = {7, type[0] == 'u' ? 9 : -2, 7};
  for (std::size_t f = 0; f < 3; ++f) {
    ply.put("uchar", 200).put("uchar", static_cast<double>(face[f].size()));
    for (const int v : face[f]) ply.put("int", v);
    ply.put(type, label[f]).put("float", 0.25).item();
  }
  return ply.str();
}

}  // namespace

TEST_CASE("labels of faces come in every format and integer type of PLY") {
  const TemporaryFolder folder;
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const std::string type : {"char", "uchar", "short", "ushort", "int", "uint"}) {
      CAPTURE(format);
      CAPTURE(type);
      put_file(folder / "a.ply", labelled(format, type));
      const int second = type[0] == 'u' ? 9 : -2;
      CHECK(read_face_labels(Work(), folder / "a.ply", "patch") == std::vector<int>{7, second, 7});
      CHECK(has_face_property(Work(), folder / "a.ply", "patch"));
      CHECK_FALSE(has_face_property(Work(), folder / "a.ply", "quality"));
      CHECK_FALSE(has_face_property(Work(), folder / "a.ply", "vertex_indices"));
    }
}

TEST_CASE("labels of polygons go to their triangles") {
  const TemporaryFolder folder;
  put_file(folder / "a.ply", labelled("ascii", "int"));
  const Soup soup = read_mesh(Work(), folder / "a.ply");
  REQUIRE(soup.face_count() == 4);
  const std::vector<int> label = read_face_labels(Work(), folder / "a.ply", "patch");
  CHECK(labels_of_triangles("a", label, soup.source_face, 4) == std::vector<int>{7, -2, 7, 7});
  CHECK(labels_of_triangles("a", {1, 2}, {}, 2) == std::vector<int>{1, 2});
  CHECK(error_of([&] { labels_of_triangles("a", {1, 2}, {}, 3); })->code() == ErrorCode::bad_file);
  CHECK(error_of([&] { labels_of_triangles("a", {1, 2}, soup.source_face, 4); })->code() == ErrorCode::bad_file);
}

TEST_CASE("a .seg file has one label a line") {
  const TemporaryFolder folder;
  put_file(folder / "a.seg", "3\n0\r\n -1 \n\n3");
  CHECK(read_face_labels(Work(), folder / "a.seg", "") == std::vector<int>{3, 0, -1, 3});
  for (const char* bad : {"1\n2 3\n", "1\n1.5\n", "1\nx\n", "99999999999\n", "", "\n"}) {
    CAPTURE(bad);
    put_file(folder / "a.seg", bad);
    const auto error = error_of([&] { read_face_labels(Work(), folder / "a.seg", ""); });
    REQUIRE(error);
    CHECK(error->code() == ErrorCode::bad_file);
    CHECK(std::string(error->what()).find("a.seg") != std::string::npos);
  }
}

TEST_CASE("what is missing from a PLY file is named") {
  const TemporaryFolder folder;
  const std::string good = labelled("binary_little_endian", "int");
  put_file(folder / "a.ply", good);
  const auto no_such = error_of([&] { read_face_labels(Work(), folder / "a.ply", "segment"); });
  REQUIRE(no_such);
  CHECK(std::string(no_such->what()).find("red, vertex_indices, patch, quality") != std::string::npos);
  CHECK(error_of([&] { read_face_labels(Work(), folder / "a.ply", "quality"); })->code() == ErrorCode::bad_file);
  CHECK(error_of([&] { read_face_labels(Work(), folder / "b.ply", "patch"); })->code() == ErrorCode::bad_file);
  for (std::size_t cut = 1; cut < 40; ++cut) {
    put_file(folder / "a.ply", good.substr(0, good.size() - 5 - cut));
    CHECK(error_of([&] { read_face_labels(Work(), folder / "a.ply", "patch"); })->code() == ErrorCode::bad_file);
  }
}

TEST_CASE("numbers of labels follow their first faces") {
  std::vector<Index> numbered;
  CHECK(number_labels({9, -4, 9, 0, -4}, numbered) == 3);
  CHECK(numbered == std::vector<Index>{0, 1, 0, 2, 1});
}
