// Files of text and plain numbers, read back by readers of the test's own.
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <doctest/doctest.h>

#include "engine/io/read_labels.h"
#include "engine/io/read_mesh.h"
#include "tests/tools/export/labelled_cube.h"
#include "tools/export/formats.h"

using namespace intarsia;
using namespace intarsia::tools;
using doctest::Approx;

namespace {

struct Written {
  test::LabelledCube cube;
  test::ProgramFolder dir{"export"};
  Written() {
    std::filesystem::create_directories(dir / "quadwild");
    write_exports(Work(), cube.handover, export_files({"all"}),
                  [&](const std::string& name) { return std::filesystem::path(dir / name); });
  }
};

Index number(const std::string& word) { return static_cast<Index>(std::stoul(word)); }
Vec3 place(const std::vector<std::string>& words, std::size_t first) {
  return {std::stod(words[first]), std::stod(words[first + 1]), std::stod(words[first + 2])};
}

}  // namespace

TEST_CASE("labels as text and as an array are the patches of the faces") {
  const Written w;
  const std::vector<int> seg = read_face_labels(Work(), w.dir / "labels.seg", "");
  REQUIRE(seg.size() == 48);
  std::map<int, std::set<int>> sides;
  for (Index f = 0; f < 48; ++f) sides[seg[f]].insert(w.cube.side_of(f));
  CHECK(sides.size() == 6);
  for (const auto& [patch, of] : sides) CHECK(of.size() == 1);
  const std::string npy = test::file_text(w.dir / "labels.npy");
  CHECK(npy.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t header = 10 + static_cast<unsigned char>(npy[8]) + 256 * static_cast<unsigned char>(npy[9]);
  CHECK(header % 64 == 0);
  CHECK(npy[header - 1] == '\n');
  CHECK(npy.find("{'descr': '<i4', 'fortran_order': False, 'shape': (48,), }") == 10);
  REQUIRE(npy.size() == header + 4 * 48);
  std::vector<std::int32_t> value(48);
  std::memcpy(value.data(), npy.data() + header, 4 * 48);
  CHECK(std::equal(value.begin(), value.end(), seg.begin()));
}

TEST_CASE("the table of patches has areas, borders and neighbours of a cube") {
  const Written w;
  std::ifstream in(w.dir / "patches.csv");
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  REQUIRE(rows.size() == 7);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin());
  };
  Vec3 sum = Vec3::Zero();
  for (std::size_t p = 1; p < 7; ++p) {
    CHECK(number(rows[p][column("patch")]) == p - 1);
    CHECK(number(rows[p][column("triangles")]) == 8);
    CHECK(std::stod(rows[p][column("area")]) == Approx(9));
    CHECK(std::stod(rows[p][column("perimeter")]) == Approx(12));
    CHECK(std::stod(rows[p][column("compactness")]) == Approx(4 / std::numbers::pi));
    CHECK(std::stod(rows[p][column("flatness")]) == Approx(1));
    CHECK(number(rows[p][column("sides")]) == 4);
    CHECK(number(rows[p][column("loops")]) == 1);
    CHECK(std::count(rows[p][column("neighbours")].begin(), rows[p][column("neighbours")].end(), ' ') == 3);
    const Vec3 middle = place(rows[p], column("centroid_x")), normal = place(rows[p], column("normal_x"));
    CHECK((middle - test::LabelledCube::kCorner - Vec3(1.5, 1.5, 1.5)).dot(normal) == Approx(1.5));
    sum += middle;
  }
  CHECK((sum / 6 - test::LabelledCube::kCorner - Vec3(1.5, 1.5, 1.5)).norm() < 1e-6);
}

TEST_CASE("obj: a group and a material for each patch, polylines for the arcs") {
  const Written w;
  std::map<std::string, std::string> material;  // group -> material
  std::map<std::string, std::vector<Index>> faces;
  std::vector<Vec3> vertex;
  std::string group, with;
  for (const auto& line : test::words_of(w.dir / "patches.obj")) {
    if (line[0] == "v") vertex.push_back(place(line, 1));
    if (line[0] == "g") group = line[1];
    if (line[0] == "usemtl") material[group] = line[1];
    if (line[0] == "f")
      for (std::size_t i = 1; i < 4; ++i) faces[group].push_back(number(line[i]) - 1);
  }
  REQUIRE(vertex.size() == w.cube.soup.vertex_count());
  for (Index v = 0; v < vertex.size(); ++v) CHECK(vertex[v] == test::point(w.cube.soup, v));
  CHECK(faces.size() == 6);
  for (Index p = 0; p < 6; ++p) {
    const std::string name = "patch_" + std::to_string(p);
    CHECK(material[name] == name);
    std::vector<Index> want;
    for (Index f = 0; f < 48; ++f)
      if (w.cube.handover.input_patch[f] == p)
        for (Index i = 0; i < 3; ++i) want.push_back(w.cube.soup.corner[3 * f + i]);
    CHECK(faces[name] == want);
  }
  std::map<std::string, Vec3> kd;
  for (const auto& line : test::words_of(w.dir / "patches.mtl")) {
    if (!line.empty() && line[0] == "newmtl") with = line[1];
    if (!line.empty() && line[0] == "Kd") kd[with] = place(line, 1);
  }
  CHECK(kd.size() == 13);
  CHECK((kd["patch_5"] - Vec3(1, 5 / 255., 100 / 255.)).norm() < 1e-4);
  CHECK(kd.contains("sharp"));
  // The program's own reader, through OpenMesh, sees the same triangles.
  const Soup again = read_mesh(Work(), w.dir / "patches.obj");
  CHECK(again.face_count() == 48);
  CHECK(again.vertex_count() == w.cube.soup.vertex_count());

  vertex.clear();
  std::set<std::string> groups;
  Index lines = 0;
  for (const auto& line : test::words_of(w.dir / "network.obj")) {
    if (line[0] == "v") vertex.push_back(place(line, 1));
    if (line[0] == "g") groups.insert(line[1]);
    if (line[0] == "usemtl") CHECK(line[1] == "sharp");
    if (line[0] != "l") continue;
    ++lines;
    REQUIRE(line.size() == 4);
    CHECK((vertex.at(number(line[1]) - 1) - vertex.at(number(line[3]) - 1)).norm() == Approx(3));
  }
  CHECK(lines == 12);
  CHECK(groups.size() == 12);
  CHECK(vertex.size() == 8 + 12);  // corners of the cube and middles of its edges
}

TEST_CASE("polylines: a line for each arc") {
  const Written w;
  const auto lines = test::words_of(w.dir / "network.polylines.txt");
  REQUIRE(lines.size() == 12);
  for (const auto& line : lines) {
    REQUIRE(line.size() == 10);
    CHECK(line[0] == "3");
    CHECK((place(line, 1) - place(line, 7)).norm() == Approx(3));
    CHECK((place(line, 1) + place(line, 7) - 2 * place(line, 4)).norm() < 1e-12);
  }
}

TEST_CASE("quadwild: every sharp edge of the cube, once, and its corners") {
  const Written w;
  std::vector<Vec3> vertex;
  std::vector<std::array<Index, 3>> face;
  for (const auto& line : test::words_of(w.dir / "quadwild/layout.obj")) {
    if (line[0] == "v") vertex.push_back(place(line, 1));
    if (line[0] == "f") face.push_back({number(line[1]) - 1, number(line[2]) - 1, number(line[3]) - 1});
  }
  REQUIRE(face.size() == 48);
  const auto is_extreme = [](const Vec3& p) {  // how many coordinates lie on the cube's planes
    int n = 0;
    for (int i = 0; i < 3; ++i) n += std::abs(std::abs(p[i] - test::LabelledCube::kCorner[i] - 1.5) - 1.5) < 1e-9;
    return n;
  };
  const auto patch = test::words_of(w.dir / "quadwild/layout.patch");
  REQUIRE(patch.size() == 49);
  CHECK(patch[0][0] == "48");
  for (Index f = 0; f < 48; ++f) CHECK(number(patch[f + 1][0]) == w.cube.handover.input_patch[f]);

  const auto sharp = test::words_of(w.dir / "quadwild/layout.sharp"),
             feature = test::words_of(w.dir / "quadwild/layout.feature");
  REQUIRE(sharp.size() == 25);
  REQUIRE(feature.size() == 25);
  CHECK(sharp[0][0] == "24");
  std::set<std::pair<Index, Index>> edges;
  for (std::size_t i = 1; i < 25; ++i) {
    unsigned kind = 9, f = 99, e = 9;
    REQUIRE(std::sscanf(sharp[i][0].c_str(), "%u,%u,%u", &kind, &f, &e) == 3);
    CHECK(kind == 1);  // convex
    CHECK(feature[i][0] == std::to_string(f) + "," + std::to_string(e));
    const Index a = face.at(f).at(e), b = face[f].at((e + 1) % 3);
    CHECK(is_extreme((vertex[a] + vertex[b]) / 2) == 2);
    edges.insert({std::min(a, b), std::max(a, b)});
  }
  CHECK(edges.size() == 24);

  const auto corners = test::words_of(w.dir / "quadwild/layout.corners");
  REQUIRE(corners.size() == 7);
  std::map<Index, int> uses;
  for (std::size_t p = 1; p < 7; ++p) {
    REQUIRE(corners[p].size() == 5);
    for (std::size_t i = 1; i < 5; ++i) {
      const Vec3 here = vertex.at(number(corners[p][i])), next = vertex.at(number(corners[p][i % 4 + 1]));
      CHECK(is_extreme(here) == 3);
      CHECK((here - next).norm() == Approx(3));  // around the side, not across
      ++uses[number(corners[p][i])];
    }
  }
  CHECK(uses.size() == 8);
  for (const auto& [v, n] : uses) CHECK(n == 3);
  const auto ends = test::words_of(w.dir / "quadwild/layout.c_feature");
  REQUIRE(ends.size() == 9);
  for (std::size_t i = 1; i < 9; ++i) CHECK(uses.contains(number(ends[i][0])));
}

TEST_CASE("--write takes formats and files, and knows what was meant") {
  CHECK(export_files({"seg", "npy"}) == FileSet{"labels.npy", "labels.seg"});
  CHECK(export_files({"vtp"}).size() == 3);
  CHECK(export_files({"layout.glb"}) == FileSet{"layout.glb"});
  CHECK(export_files({"none"}).empty());
  CHECK(export_files({"ply"}).empty());
  CHECK(export_files({"all"}).size() == export_names().size());
  const auto message = [](const std::string& item) -> std::string {
    try {
      export_files({"csv", item});
    } catch (const Error& e) {
      CHECK(e.code() == ErrorCode::bad_argument);
      return e.what();
    }
    return "";
  };
  CHECK(message("vpt").find("did you mean 'vtp'") != std::string::npos);
  CHECK(message("htm").find("did you mean 'html'") != std::string::npos);
  CHECK(message("patchs.obj").find("did you mean 'patches.obj'") != std::string::npos);
}
