#include "engine/io/read_mesh.h"

#include <cstdio>
#include <cstring>
#include <thread>

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "engine/io/plain_text.h"
#include "engine/io/read_stl.h"
#include "engine/io/read_with_openmesh.h"
#include "tests/engine/io/io_support.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

Soup obj(const std::string& text) {
  return read_with_openmesh(Work{}, "t.obj", plain_obj(Work{}, "t.obj", text), "obj");
}
Soup off(const std::string& text) {
  return read_with_openmesh(Work{}, "t.off", plain_off(Work{}, "t.off", text), "off");
}
Soup stl(const std::string& bytes) { return read_stl(Work{}, "t.stl", bytes); }

const std::string kThree = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

using Triangle = std::array<std::array<float, 3>, 3>;

std::string binary_stl(const std::vector<Triangle>& triangles, const std::string& title = "solid or not") {
  std::string bytes = title;
  bytes.resize(80, ' ');
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& t : triangles) {
    put(std::array<float, 3>{});
    put(t);
    put(std::uint16_t{0});
  }
  return bytes;
}

std::string ascii_stl(const std::vector<Triangle>& triangles) {
  std::string text = "solid part of a test\n";
  char line[200];
  for (const Triangle& t : triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const auto& p : t) {
      std::snprintf(line, sizeof line, "      vertex %.9g %.9g %.9g\n", p[0], p[1], p[2]);
      text += line;
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid part of a test\n";
}

void refused(const std::optional<Error>& error, const std::string& reason, Index element = kNone) {
  REQUIRE(error);
  CHECK(error->code() == ErrorCode::bad_file);
  CHECK_MESSAGE(mentions(error, reason), error->what());
  if (element != kNone) CHECK(error->element() == element);
}

}  // namespace

TEST_CASE("OBJ: all ways to write a corner, and relative indices between groups") {
  const std::string normals = "vn 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n";
  for (const std::string face :
       {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/3/1", "f -3 -2 -1", "f -3//-1 -2//-1 -1//-1",
        "f\t1  2 3  ", "  f 1 2 3 # why not", "f 1/ 2/ 3/", "fo 1 2 3", "f 1 2 \\\n 3", "# C:\\meshes\\\nf 1 2 3"}) {
    const Soup soup = obj(kThree + normals + face + "\r\n");
    CHECK(soup.corner == std::vector<Index>{0, 1, 2});
    CHECK(soup.x == std::vector<Real>{0, 1, 0});
    CHECK(soup.y == std::vector<Real>{0, 0, 1});
  }
  const Soup soup = obj(kThree + "f -3 -2 -1\no second\ng a b\n" + kThree + "s off\nf -3 -2 -1\nf 6 -6 2\n");
  CHECK(soup.vertex_count() == 6);
  CHECK(soup.corner == std::vector<Index>{0, 1, 2, 3, 4, 5, 5, 0, 1});
}

TEST_CASE("OBJ: doubles are kept, weights and colours of vertices ignored") {
  const Soup soup = obj("v 100000000.123 0 1e-300 1.0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nf 1 2 3");
  CHECK(soup.x[0] == 100000000.123);
  CHECK(soup.z[0] == 1e-300);
}

TEST_CASE("OBJ and OFF: polygons are split, odd faces keep their number") {
  const Soup a = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2\nf 1 2 3 4\nf 2 2 3\nf 1 3 4\nf 1 2 3 1\nf 4\n");
  const Soup b = off("OFF\n4 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 1\n4 0 1 2 3\n3 1 1 2\n3 0 2 3\n4 0 1 2 0\n1 3\n");
  for (const Soup& soup : {a, b}) {
    CHECK(soup.vertex_count() == 4);
    CHECK(soup.corner == std::vector<Index>{0, 1, 2, 0, 2, 3, 1, 1, 2, 0, 2, 3, 0, 1, 2, 0, 2, 0});
    CHECK(soup.source_face == std::vector<Index>{1, 1, 2, 3, 4, 4});
  }
}

TEST_CASE("OBJ: what OpenMesh would skip in silence is refused, with line and element") {
  refused(error_of([] { obj("v 0 0 0\nv 1 x 0\nv 1 0 0\nv 0 1 0\nf 1 2 3"); }), "line 2: vertex 1", 1);
  refused(error_of([] { obj("v 0 0\n"); }), "fewer than three", 0);
  refused(error_of([] { obj("v 0,5 0 0\n"); }), "0,5", 0);
  refused(error_of([] { obj(kThree + "v nan 0 0\n"); }), "line 4", 3);
  refused(error_of([] { obj(kThree + "v 0 -inf 0\n"); }), "usable", 3);
  refused(error_of([] { obj(kThree + "f 1 2 3\nf 1 2 4\n"); }), "names vertex 3", 1);
  refused(error_of([] { obj(kThree + "f 1 2 -4\n"); }), "names vertex -1", 0);
  refused(error_of([] { obj(kThree + "f 0 1 2\n"); }), "'0'", 0);
  refused(error_of([] { obj(kThree + "f a b c\n"); }), "'a'", 0);
  refused(error_of([] { obj(kThree + "f 1 2 99999999999\n"); }), "99999999999", 0);
  refused(error_of([] { obj(kThree + "f 1 2 99999999999999999999\n"); }), "names no vertex", 0);
}

TEST_CASE("OFF: comments, colours, normals, counts behind the word") {
  for (const std::string begin :
       {"OFF\n3 1 0\n", "OFF 3 1 0\n", "OFF3 1 0\n", "# c\nOFF # c\n\n# c\n3 1 0 # c\n", "OFF\r\n3 1 3\r\n"}) {
    const Soup soup = off(begin + "0 0 0\n\n# c\n1 0 0 # c\n0 1 100000000.5\n3 0 1 2\n");
    CHECK(soup.corner == std::vector<Index>{0, 1, 2});
    CHECK(soup.z[2] == 100000000.5);
  }
  const Soup soup = off("STCNOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2 255 0 0\n");
  CHECK(soup.x == std::vector<Real>{0, 1, 0});
}

TEST_CASE("OFF: damage is refused") {
  const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
  refused(error_of([&] { off("OFF\n3 2 0\n" + three + "3 0 1 2\n"); }), "ends before face 1");
  refused(error_of([&] { off("OFF\n3 1 0\n0 0 0\n1 0"); }), "vertex 1", 1);
  refused(error_of([&] { off("OFF\n3 1 0\n" + three + "3 0 1 7\n"); }), "names vertex 7", 0);
  refused(error_of([&] { off("OFF\n3 1 0\n" + three + "3 0 -1 2\n"); }), "names vertex -1", 0);
  refused(error_of([&] { off("OFF\n3 1 0\n" + three + "2000000000 0 1 2\n"); }), "fewer corners", 0);
  refused(error_of([&] { off("OFF\n3000000000 2000000000 0\n" + three + "3 0 1 2\n"); }), "line");
  refused(error_of([&] { off("OFF\n-3 1 0\n" + three + "3 0 1 2\n"); }), "counts");
  refused(error_of([&] { off("OFF\n3 1 0\n" + three + "3 0 1 2\n3 0 1 2\n"); }), "more data");
  refused(error_of([&] { off("OFF BINARY\n"); }), "binary");
  refused(error_of([&] { off("4OFF\n"); }), "OFF");
  refused(error_of([&] { off("OFF\n3 1 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"); }), "usable", 0);
}

TEST_CASE("STL: binary and ascii give the same welded surface, triangles in file order") {
  // A tetrahedron, a triangle that has no area, and one that meets a corner with -0.
  const std::array<float, 3> a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0.1f, 0.2f, 0.3f}, minus{-0.0f, 0, -0.0f};
  const std::vector<Triangle> triangles = {{a, c, b}, {a, b, d}, {b, c, d}, {b, b, d}, {c, minus, d}};
  for (const std::string& bytes : {binary_stl(triangles), ascii_stl(triangles), binary_stl(triangles) + "\n"}) {
    const Soup soup = stl(bytes);
    CHECK(soup.corner == std::vector<Index>{0, 1, 2, 0, 2, 3, 2, 1, 3, 2, 2, 3, 1, 0, 3});
    CHECK(soup.x[3] == doctest::Approx(0.1));
    CHECK(soup.vertex_count() == 4);
    CHECK(soup.source_face.empty());
  }
}

TEST_CASE("STL: welding agrees with a plain search on many corners") {
  const Random random(3, 3);
  std::vector<Triangle> triangles(4000);
  for (std::uint64_t i = 0; i < triangles.size(); ++i)
    for (std::uint64_t k = 0; k < 9; ++k)
      triangles[i][k / 3][k % 3] =
          static_cast<float>(random.bits(i, k) % 12) * (random.bits(i, k + 9) % 2 ? -0.5f : 0.5f);
  const Soup soup = stl(binary_stl(triangles));
  REQUIRE(soup.face_count() == triangles.size());
  std::vector<std::array<float, 3>> known;
  bool same = true;
  for (std::size_t i = 0; i < 3 * triangles.size(); ++i) {
    const auto& p = triangles[i / 3][i % 3];
    const auto found = std::find(known.begin(), known.end(), p);
    same &= soup.corner[i] == static_cast<Index>(found - known.begin());
    if (found == known.end()) known.push_back(p);
  }
  CHECK(same);
  REQUIRE(soup.vertex_count() == known.size());
  for (std::size_t v = 0; v < known.size(); ++v)
    same &= soup.x[v] == known[v][0] && soup.y[v] == known[v][1] && soup.z[v] == known[v][2];
  CHECK(same);
}

TEST_CASE("STL: several solids, capital letters") {
  std::string text = ascii_stl({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}});
  std::string loud = text;
  for (char& ch : loud) ch = ch >= 'a' && ch <= 'z' ? static_cast<char>(ch - 'a' + 'A') : ch;
  loud.replace(0, 5, "solid");
  CHECK(stl(text + loud).corner == std::vector<Index>{0, 1, 2, 0, 1, 2});
}

TEST_CASE("STL: cut and wrong files are refused") {
  const std::vector<Triangle> triangles(5, Triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  const std::string binary = binary_stl(triangles), text = ascii_stl(triangles);
  for (std::size_t size = 0; size < binary.size(); size += 7)
    refused(error_of([&] { stl(binary.substr(0, size)); }), "");
  for (std::size_t size = 0; size + 1 < text.size() - 24; size += 11)
    refused(error_of([&] { stl(text.substr(0, size)); }), "");
  refused(error_of([&] { stl(binary + binary); }), "5 triangles");
  std::string lies = binary;
  std::memset(lies.data() + 80, 0xff, 4);
  refused(error_of([&] { stl(lies); }), "4294967295");
  auto bad = triangles;
  bad[3][1][2] = std::numeric_limits<float>::quiet_NaN();
  refused(error_of([&] { stl(binary_stl(bad)); }), "triangle 3", 3);
  refused(error_of([&] { stl(ascii_stl(bad)); }), "triangle 3", 3);
  refused(error_of([&] { stl("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0,5 0 0\n"); }), "0,5", 0);
}

TEST_CASE("the kind of file is told by its first bytes, then by its extension in any case") {
  const TemporaryFolder folder;
  const std::string off_text = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::string ply_text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  put_file(folder / "a.PLY", ply_text);
  put_file(folder / "b b \xc3\xbc.Obj", kThree + "f 1 2 3\n");
  put_file(folder / "c.STL", binary_stl({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}));
  put_file(folder / "d.OFF", off_text);
  put_file(folder / "e.stl", ply_text);
  put_file(folder / "f", off_text);
  for (const char* name : {"a.PLY", "b b \xc3\xbc.Obj", "c.STL", "d.OFF", "e.stl", "f"}) {
    const Soup soup = read_mesh(Work{}, folder / name);
    CHECK(soup.corner == std::vector<Index>{0, 1, 2});
    CHECK(soup.x == std::vector<Real>{0, 1, 0});
  }
}

TEST_CASE("files that hold no surface are refused by name") {
  const TemporaryFolder folder;
  const auto refuse = [&](const std::string& name, const std::string& bytes, const std::string& reason) {
    put_file(folder / name, bytes);
    const auto error = error_of([&] { read_mesh(Work{}, folder / name); });
    refused(error, reason);
    CHECK(mentions(error, name));
  };
  for (const char* name : {"e.ply", "e.obj", "e.stl", "e.off", "e.xyz"}) refuse(name, "", "empty");
  refuse("points.obj", kThree, "no triangles");
  refuse("lines.obj", kThree + "f 1 2\n", "no triangles");
  refuse("points.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no triangles");
  refuse("none.stl", "solid\nendsolid\n", "no triangles");
  refuse("none.off", "OFF\n0 0 0\n", "no triangles");
  refuse("none.obj", "# nothing\n", "no triangles");
  refuse("notes.txt", "hello", ".ply, .obj, .stl or .off");
  refuse("text.ply", "hello\n", "begin");
  refuse("text.stl", "hello\n", "STL");
  refuse("text.off", "hello\n", "OFF");
  refused(error_of([&] { read_mesh(Work{}, folder / "absent.ply"); }), "absent.ply");
  refused(error_of([&] { read_mesh(Work{}, folder.path()); }), "folder");
  refused(error_of([&] { read_mesh(Work{}, "/dev/zero"); }), "regular");
}

TEST_CASE("a cancelled run stops reading") {
  const std::atomic<bool> cancel{true};
  const Work work(&cancel, nullptr, Order::fixed);
  for (const auto& error : {error_of([&] { plain_obj(work, "t", std::string(100000, '\n')); }),
                            error_of([&] { read_with_openmesh(work, "t", plain_obj(Work{}, "t", kThree), "obj"); }),
                            error_of([&] { read_stl(work, "t", binary_stl({Triangle{}})); })}) {
    REQUIRE(error);
    CHECK(error->code() == ErrorCode::cancelled);
  }
  CHECK(obj(kThree + "f 1 2 3\n").face_count() == 1);  // OpenMesh's reader survives it
}

TEST_CASE("several files may be read at once") {
  std::vector<std::thread> threads;
  std::vector<Index> faces(4);
  for (std::size_t t = 0; t < faces.size(); ++t)
    threads.emplace_back([t, &faces] {
      for (int repeat = 0; repeat < 20; ++repeat) {
        std::string text = kThree;
        for (std::size_t f = 0; f <= t; ++f) text += "f 1 2 3\n";
        faces[t] = obj(text).face_count();
      }
    });
  for (auto& thread : threads) thread.join();
  CHECK(faces == std::vector<Index>{1, 2, 3, 4});
}

TEST_CASE("damaged text gives a sound surface or an error") {
  const Random random(11, 2);
  const std::string samples[] = {
      kThree + "v 1 1 0\nf 1 2 3\nf -1 -2 -3\nf 1//1 2//1 4//1 3\n",
      "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 2 3\n4 0 1 2 3\n",
      ascii_stl({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}}),
      binary_stl({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}})};
  for (std::uint64_t seed = 0; seed < 8000; ++seed) {
    std::string text = samples[seed % 4];
    for (std::uint64_t k = 0; k < 1 + random.bits(seed, 0) % 3; ++k) {
      const std::uint64_t r = random.bits(seed, k + 1);
      const char replacements[] = {' ', '\n', '-', '9', '/', '.', '#', static_cast<char>(r >> 40)};
      text[(r >> 8) % text.size()] = replacements[r % 8];
      if (r % 61 == 0) text.resize(1 + (r >> 16) % text.size());
    }
    try {
      const Soup soup = seed % 4 == 0 ? obj(text) : seed % 4 == 1 ? off(text) : stl(text);
      bool sound = soup.corner.size() % 3 == 0;
      for (const Index c : soup.corner) sound &= c < soup.vertex_count();
      for (const auto* a : {&soup.x, &soup.y, &soup.z})
        for (const Real value : *a) sound &= std::abs(value) <= 1e100;
      REQUIRE(sound);
    } catch (const Error& error) {
      REQUIRE_MESSAGE(error.code() == ErrorCode::bad_file, error.what() << " in " << text);
    }
  }
}
