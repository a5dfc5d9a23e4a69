#include "engine/io/read_ply.h"

#include <limits>

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "tests/engine/io/io_support.h"
#include "tests/engine/io/ply_builder.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

const std::string kFormats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
constexpr int kSide = 70;  // vertices per side of the sheet: enough for two blocks of the parallel loops

// A sheet of 2 (kSide - 1)^2 triangles; coordinates are small integers, so that every type can hold them.
struct Sheet {
  std::vector<std::array<int, 3>> vertex, face;
  Sheet() {
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) vertex.push_back({i, j, (i * j) % 7});
    for (int j = 0; j + 1 < kSide; ++j)
      for (int i = 0; i + 1 < kSide; ++i) {
        const int v = j * kSide + i;
        face.push_back({v, v + 1, v + kSide});
        face.push_back({v + 1, v + kSide + 1, v + kSide});
      }
  }
};

void check_sheet(const Soup& soup) {
  const Sheet sheet;
  REQUIRE(soup.x.size() == sheet.vertex.size());
  REQUIRE(soup.face_count() == sheet.face.size());
  CHECK(soup.source_face.empty());
  bool same = true;
  for (std::size_t v = 0; v < sheet.vertex.size(); ++v)
    same &= soup.x[v] == sheet.vertex[v][0] && soup.y[v] == sheet.vertex[v][1] && soup.z[v] == sheet.vertex[v][2];
  CHECK(same);
  for (std::size_t f = 0; f < sheet.face.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) same &= soup.corner[3 * f + i] == static_cast<Index>(sheet.face[f][i]);
  CHECK(same);
}

Soup read(const std::string& bytes) { return read_ply(Work{}, "test.ply", bytes); }

std::string sheet_file(const std::string& format, const std::string& coordinate, const std::string& count,
                       const std::string& index, const std::string& list_name = "vertex_indices") {
  const Sheet sheet;
  PlyBuilder ply(format);
  ply.line("element vertex " + std::to_string(sheet.vertex.size()));
  for (const char* name : {"x", "y", "z"}) ply.line("property " + coordinate + " " + name);
  ply.line("element face " + std::to_string(sheet.face.size()));
  ply.line("property list " + count + " " + index + " " + list_name).line("end_header");
  for (const auto& v : sheet.vertex) {
    for (const int c : v) ply.put(coordinate, c);
    ply.item();
  }
  for (const auto& f : sheet.face) {
    ply.put(count, 3);
    for (const int c : f) ply.put(index, c);
    ply.item();
  }
  return ply.str();
}

// Four vertices and what the caller adds.
PlyBuilder square(const std::string& format, const std::string& elements, const std::string& line_end = "\n") {
  PlyBuilder ply(format, line_end);
  ply.line("element vertex 4").line("property float x").line("property float y").line("property float z");
  std::istringstream lines(elements);
  for (std::string line; std::getline(lines, line);) ply.line(line);
  ply.line("end_header");
  for (const auto& v : {std::array{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) {
    for (const int c : v) ply.put("float", c);
    ply.item();
  }
  return ply;
}

}  // namespace

TEST_CASE("every format and every type of coordinate, count and index reads the same surface") {
  const std::string coordinates[] = {"char", "uchar", "short", "ushort", "int",   "uint",   "float",   "double",
                                     "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};
  const std::string integers[] = {"char", "uchar", "short", "ushort", "int", "uint"};
  for (const auto& format : kFormats) {
    for (const auto& type : coordinates) check_sheet(read(sheet_file(format, type, "uchar", "int")));
    for (const auto& type : integers) check_sheet(read(sheet_file(format, "float", type, "uint", "vertex_index")));
    for (const auto& type : {"short", "ushort", "int", "uint"})
      check_sheet(read(sheet_file(format, "double", "int", type)));
  }
}

TEST_CASE("doubles keep all their bits, floats those of a float") {
  const double value = 100000000.123456789;
  for (const auto& format : kFormats)
    for (const std::string type : {"double", "float"}) {
      PlyBuilder ply(format);
      ply.line("element vertex 3");
      for (const char* name : {"x", "y", "z"}) ply.line("property " + type + " " + name);
      ply.line("element face 1").line("property list uchar int vertex_indices").line("end_header");
      for (int v = 0; v < 3; ++v) ply.put(type, value).put(type, v).put(type, v * v).item();
      ply.put("uchar", 3).put("int", 0).put("int", 1).put("int", 2).item();
      const Soup soup = read(ply.str());
      CHECK(soup.x[1] == (type == "double" ? value : static_cast<double>(static_cast<float>(value))));
    }
}

TEST_CASE("other properties and elements are skipped, wherever they stand") {
  const Sheet sheet;
  for (const auto& format : kFormats) {
    PlyBuilder ply(format);
    ply.line("comment made for a test").line("obj_info anything").line("comment");
    ply.line("element camera 2").line("property double view").line("property list uchar short taps");
    ply.line("element vertex " + std::to_string(sheet.vertex.size()));
    ply.line("property uchar red").line("property float z").line("property double x").line("property int y");
    ply.line("element nothing 1000000000000").line("element face " + std::to_string(sheet.face.size()));
    ply.line("property short flag").line("property list uint uint vertex_indices").line("property double area");
    ply.line("element edge 2").line("property int vertex1").line("property int vertex2").line("end_header");
    ply.put("double", 0.5).put("uchar", 0).item();
    ply.put("double", 0.5).put("uchar", 1).put("short", 7).item();
    for (const auto& v : sheet.vertex)
      ply.put("uchar", 255).put("float", v[2]).put("double", v[0]).put("int", v[1]).item();
    for (const auto& f : sheet.face) {
      ply.put("short", -1).put("uint", 3);
      for (const int c : f) ply.put("uint", c);
      ply.put("double", 0.25).item();
    }
    for (int e = 0; e < 2; ++e) ply.put("int", e).put("int", e + 1).item();
    check_sheet(read(ply.str()));
  }
}

TEST_CASE("lists beside the coordinates and beside the corners are skipped") {
  for (const auto& format : kFormats) {
    PlyBuilder ply(format);
    ply.line("element vertex 3")
        .line("property float x")
        .line("property list uchar int seen_by")
        .line("property float y");
    ply.line("property float z").line("element face 2").line("property list uchar float texcoord");
    ply.line("property list uchar int vertex_indices").line("end_header");
    for (int v = 0; v < 3; ++v) {
      ply.put("float", v).put("uchar", v);
      for (int i = 0; i < v; ++i) ply.put("int", i);
      ply.put("float", v * v).put("float", 1).item();
    }
    for (int f = 0; f < 2; ++f) {
      ply.put("uchar", 6);
      for (int i = 0; i < 6; ++i) ply.put("float", 0.5);
      ply.put("uchar", 3).put("int", f).put("int", 1 - f).put("int", 2).item();
    }
    const Soup soup = read(ply.str());
    CHECK(soup.x == std::vector<Real>{0, 1, 2});
    CHECK(soup.y == std::vector<Real>{0, 1, 4});
    CHECK(soup.corner == std::vector<Index>{0, 1, 2, 1, 0, 2});
  }
}

TEST_CASE("polygons become fans and tell their face") {
  const std::string element = "element face 4\nproperty list uchar int vertex_indices";
  for (const auto& format : kFormats) {
    PlyBuilder mixed = square(format, element);
    for (const auto& face : {std::vector{0, 1, 2}, {0, 1, 2, 3}, {1, 2}, {3, 0, 1}}) {
      mixed.put("uchar", static_cast<double>(face.size()));
      for (const int c : face) mixed.put("int", c);
      mixed.item();
    }
    const Soup soup = read(mixed.str());
    CHECK(soup.corner == std::vector<Index>{0, 1, 2, 0, 1, 2, 0, 2, 3, 3, 0, 1});
    CHECK(soup.source_face == std::vector<Index>{0, 1, 1, 3});

    PlyBuilder quads = square(format, element);  // all of one size: the parallel way
    for (int f = 0; f < 4; ++f) {
      quads.put("uchar", 4);
      for (int i = 0; i < 4; ++i) quads.put("int", (f + i) % 4);
      quads.item();
    }
    const Soup split = read(quads.str());
    CHECK(split.corner == std::vector<Index>{0, 1, 2, 0, 2, 3, 1, 2, 3, 1, 3, 0, 2, 3, 0, 2, 0, 1, 3, 0, 1, 3, 1, 2});
    CHECK(split.source_face == std::vector<Index>{0, 0, 1, 1, 2, 2, 3, 3});
  }
}

TEST_CASE("triangle strips turn every second triangle, restart at -1 and leave out what has no area") {
  for (const auto& format : kFormats) {
    PlyBuilder ply = square(format, "element tristrips 2\nproperty list int int vertex_indices");
    ply.put("int", 10);
    for (const int c : {0, 1, 3, 2, -1, 0, 1, 1, 2, 3}) ply.put("int", c);
    ply.item().put("int", 3);
    for (const int c : {3, 2, 1}) ply.put("int", c);
    ply.item();
    const Soup soup = read(ply.str());
    // The second strip has 011, 112 (both without area) and then 123, its third triangle: not turned.
    CHECK(soup.corner == std::vector<Index>{0, 1, 3, 3, 1, 2, 1, 2, 3, 3, 2, 1});
    CHECK(soup.source_face.empty());
  }
}

TEST_CASE("faces with repeated corners stay") {
  PlyBuilder ply = square("binary_little_endian", "element face 2\nproperty list uchar int vertex_indices");
  ply.put("uchar", 3).put("int", 1).put("int", 1).put("int", 2);
  ply.put("uchar", 3).put("int", 0).put("int", 1).put("int", 2);
  CHECK(read(ply.str()).corner == std::vector<Index>{1, 1, 2, 0, 1, 2});
}

TEST_CASE("line ends of all systems, also before binary data that begin with a line feed") {
  for (const std::string end : {"\n", "\r\n", "\r"})
    for (const auto& format : kFormats) {
      PlyBuilder ply(format, end);
      ply.line("element vertex 3").line("property uchar x").line("property uchar y").line("property uchar z");
      ply.line("element face 1").line("property list uchar uchar vertex_indices").line("end_header");
      for (int v = 0; v < 3; ++v) ply.put("uchar", 10).put("uchar", 13).put("uchar", v).item();
      for (const int b : {3, 0, 1, 2}) ply.put("uchar", b);
      const Soup soup = read(ply.str());
      CHECK(soup.x == std::vector<Real>{10, 10, 10});
      CHECK(soup.y == std::vector<Real>{13, 13, 13});
      CHECK(soup.z == std::vector<Real>{0, 1, 2});
    }
}

TEST_CASE("a face with a bad corner is named") {
  for (const auto& format : kFormats)
    for (const int bad : {4, -1, 2000000000})
      for (const bool mixed : {false, true}) {
        PlyBuilder ply = square(format, "element face 3\nproperty list uchar int vertex_indices");
        for (const int last : {2, 3, bad}) {
          ply.put("uchar", mixed && last == 3 ? 4 : 3).put("int", 0).put("int", 1);
          if (mixed && last == 3) ply.put("int", 2);
          ply.put("int", last).item();
        }
        const auto error = error_of([&] { read(ply.str()); });
        REQUIRE(error);
        CHECK(error->code() == ErrorCode::bad_file);
        CHECK(error->element() == 2);
        CHECK(mentions(error, "test.ply"));
        CHECK(mentions(error, "vertex " + std::to_string(bad)));
      }
}

TEST_CASE("a coordinate that is no number is named") {
  for (const auto& format : kFormats)
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200}) {
      PlyBuilder ply(format);
      ply.line("element vertex 3").line("property double x").line("property double y").line("property double z");
      ply.line("element face 1").line("property list uchar int vertex_indices").line("end_header");
      for (int v = 0; v < 3; ++v) ply.put("double", v).put("double", v == 1 ? bad : 0).put("double", 0).item();
      ply.put("uchar", 3).put("int", 0).put("int", 1).put("int", 2);
      const auto error = error_of([&] { read(ply.str()); });
      REQUIRE(error);
      CHECK(error->code() == ErrorCode::bad_file);
      CHECK(error->element() == 1);
    }
}

TEST_CASE("headers that promise more than the file can hold are refused at once") {
  const std::string face = "property list uchar int vertex_indices\nend_header\n";
  for (const auto& format : kFormats)
    for (const std::string count : {"4000000000", "4000000000000000000", "-1", "99999999999999999999", "x", ""}) {
      const std::string begin = "ply\nformat " + format + " 1.0\n";
      const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
      const std::string tail(100, '\1');
      for (const std::string& file :
           {begin + "element vertex " + count + "\n" + xyz + "element face 1\n" + face + tail,
            begin + "element vertex 3\n" + xyz + "element face " + count + "\n" + face + tail,
            begin + "element vertex 3\n" + xyz + "element tristrips " + count + "\n" + face + tail,
            begin + "element other " + count + "\n" + xyz + "element face 1\n" + face + tail}) {
        const auto error = error_of([&] { read(file); });
        REQUIRE(error);
        CHECK(error->code() == ErrorCode::bad_file);
      }
    }
}

TEST_CASE("a list that promises more items than there are bytes is refused") {
  for (const auto& format : kFormats)
    for (const double count : {4294967295.0, 100.0}) {
      PlyBuilder ply = square(format, "element face 1\nproperty list uint int vertex_indices");
      if (format == "ascii") ply.bytes(count > 1000 ? "4294967295 0 1 2" : "100 0 1 2");
      if (format != "ascii") ply.put("uint", count).put("int", 0).put("int", 1).put("int", 2);
      const auto error = error_of([&] { read(ply.str()); });
      REQUIRE(error);
      CHECK(error->code() == ErrorCode::bad_file);
    }
  PlyBuilder ply = square("binary_little_endian", "element face 1\nproperty list char int vertex_indices");
  ply.put("char", -3).put("int", 0).put("int", 1).put("int", 2);
  CHECK(error_of([&] { read(ply.str()); })->code() == ErrorCode::bad_file);
}

TEST_CASE("a cut file is refused wherever it is cut, data behind the end too") {
  for (const auto& format : kFormats) {
    PlyBuilder ply = square(format, "element face 2\nproperty list uchar int vertex_indices");
    ply.put("uchar", 3).put("int", 0).put("int", 1).put("int", 2).item();
    ply.put("uchar", 3).put("int", 0).put("int", 2).put("int", 3);
    const std::string whole = ply.str().substr(0, format == "ascii" ? ply.str().size() - 1 : std::string::npos);
    CHECK(read(whole).face_count() == 2);
    CHECK(read(whole + "\r\n").face_count() == 2);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const auto error = error_of([&] { read(whole.substr(0, size)); });
      REQUIRE(error);
      CHECK(error->code() == ErrorCode::bad_file);
    }
    CHECK(error_of([&] { read(whole + " 17"); })->code() == ErrorCode::bad_file);
  }
}

TEST_CASE("headers that make no sense are refused with a reason") {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string list = "property list uchar int vertex_indices\n";
  const std::string three = "0 0 0 1 0 0 0 1 0 ", face = "3 0 1 2";
  const auto refused = [&](const std::string& header, const std::string& reason) {
    const auto error = error_of([&] { read(header + "end_header\n" + three + face); });
    REQUIRE(error);
    CHECK(error->code() == ErrorCode::bad_file);
    CHECK_MESSAGE(mentions(error, reason), error->what());
  };
  const std::string ascii = "ply\nformat ascii 1.0\n";
  refused("plx\n", "does not begin");
  refused("ply\nelement vertex 3\n" + xyz + "element face 1\n" + list, "format");
  refused("ply\nformat morse 1.0\n", "morse");
  refused(ascii + "element vertex 3\nproperty float x\nproperty float y\nelement face 1\n" + list, "property z");
  refused(ascii + "element vertex 3\n" + xyz + "element face 1\nproperty list uchar int corners\n", "vertex_indices");
  refused(ascii + "element vertex 3\n" + xyz + "element face 1\nproperty int vertex_indices\n", "list");
  refused(ascii + "element vertex 3\n" + xyz + "element face 1\nproperty list uchar float vertex_indices\n",
          "integers");
  refused(ascii + "element vertex 3\n" + xyz + "element face 1\nproperty list float int vertex_indices\n",
          "count type");
  refused(ascii + "element vertex 3\nproperty quad x\n", "quad");
  refused(ascii + "property float x\n", "before the first element");
  refused(ascii + "element vertex 3\n" + xyz + "element vertex 3\n" + xyz, "twice");
  refused(ascii + "element vertex 0\n" + xyz + "element face 1\n" + list, "no vertices");
  refused(ascii + "bones 12\n", "bones");
}

TEST_CASE("a decimal comma is not taken for the end of a number") {
  const auto error = error_of([] {
    read(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1,5 0 0\n0 1 0\n3 0 1 2\n");
  });
  REQUIRE(error);
  CHECK(error->element() == 1);
  CHECK(mentions(error, "1,5"));
}

TEST_CASE("damaged files give a sound surface or an error, never anything else") {
  const Random random(7, 1);
  std::uint64_t accepted = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 6000; ++seed) {
    PlyBuilder ply = square(kFormats[seed % 3], seed % 2 ? "element face 3\nproperty list uchar int vertex_indices"
                                                         : "element tristrips 1\nproperty list int int vertex_index");
    if (seed % 2) {
      for (int f = 0; f < 3; ++f) ply.put("uchar", 3).put("int", 0).put("int", f).put("int", 3).item();
    } else {
      ply.put("int", 6);
      for (const int c : {0, 1, 2, -1, 2, 3}) ply.put("int", c);
    }
    std::string bytes = ply.str();
    for (std::uint64_t k = 0; k < 1 + random.bits(seed, 0) % 4; ++k) {
      const std::uint64_t r = random.bits(seed, k + 1);
      bytes[(r >> 8) % bytes.size()] = static_cast<char>(r & 1 ? r >> 40 : '0' + (r >> 40) % 10);
    }
    try {
      const Soup soup = read(bytes);
      ++accepted;
      bool sound = soup.corner.size() % 3 == 0;
      for (const Index c : soup.corner) sound &= c < soup.vertex_count();
      for (const auto* a : {&soup.x, &soup.y, &soup.z})
        for (const Real value : *a) sound &= std::abs(value) <= 1e100;
      sound &= soup.source_face.empty() || soup.source_face.size() == soup.face_count();
      REQUIRE(sound);
    } catch (const Error& error) {
      ++refused;
      const bool expected = error.code() == ErrorCode::bad_file || error.code() == ErrorCode::too_large;
      REQUIRE(expected);
    }
  }
  CHECK(accepted > 100);
  CHECK(refused > 100);
}
