// .vtp and .glb read back: always by small readers of the test's own, and by VTK and Assimp where they are installed.
#include <cstdlib>
#include <cstring>
#include <set>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/export/labelled_cube.h"
#include "tools/export/write_glb.h"
#include "tools/export/write_obj.h"
#include "tools/export/write_vtp.h"

using namespace intarsia;
using namespace intarsia::tools;
using doctest::Approx;

namespace {

// Appended raw arrays by name.
class Vtp {
 public:
  explicit Vtp(const std::string& path) : text_(test::file_text(path)) {
    data_ = text_.find("<AppendedData encoding=\"raw\">\n_") + std::strlen("<AppendedData encoding=\"raw\">\n_");
  }
  std::string attribute(const std::string& of, const std::string& name) const {
    const std::size_t tag = text_.find(of);
    REQUIRE(tag != std::string::npos);
    const std::size_t at = text_.find(" " + name + "=\"", tag) + name.size() + 3;
    return text_.substr(at, text_.find('"', at) - at);
  }
  template <class T>
  std::vector<T> array(const std::string& name) const {
    const std::string tag = "Name=\"" + name + "\"";
    const std::size_t at = data_ + std::stoul(attribute(tag, "offset"));
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, text_.data() + at, 8);
    REQUIRE(at + 8 + bytes <= text_.size());
    std::vector<T> out(bytes / sizeof(T));
    std::memcpy(out.data(), text_.data() + at + 8, bytes);
    return out;
  }

 private:
  std::string text_;
  std::size_t data_ = 0;
};

bool has(const char* command) { return std::system((std::string(command) + " >/dev/null 2>&1").c_str()) == 0; }

}  // namespace

TEST_CASE("vtp: the triangles and patches of a cube") {
  const test::LabelledCube cube;
  const test::ProgramFolder dir("vtp");
  write_patches_vtp(dir / "patches.vtp", cube.handover);
  const Vtp vtp(dir / "patches.vtp");
  CHECK(vtp.attribute("<VTKFile", "header_type") == "UInt64");
  CHECK(vtp.attribute("<Piece", "NumberOfPoints") == "26");
  CHECK(vtp.attribute("<Piece", "NumberOfPolys") == "48");
  CHECK(vtp.attribute("Name=\"Points\"", "NumberOfComponents") == "3");
  const auto point = vtp.array<float>("Points");  // the cube's coordinates are floats
  REQUIRE(point.size() == 78);
  for (Index v = 0; v < 26; ++v)
    CHECK((Vec3(point[3 * v], point[3 * v + 1], point[3 * v + 2]) - test::point(cube.soup, v)).norm() == 0);
  const auto corner = vtp.array<std::int64_t>("connectivity"), offset = vtp.array<std::int64_t>("offsets");
  CHECK(std::equal(corner.begin(), corner.end(), cube.soup.corner.begin(), cube.soup.corner.end()));
  REQUIRE(offset.size() == 48);
  CHECK(offset.front() == 3);
  CHECK(offset.back() == 144);
  const auto patch = vtp.array<std::int32_t>("patch_id");
  CHECK(std::equal(patch.begin(), patch.end(), cube.handover.input_patch.begin(), cube.handover.input_patch.end()));
}

TEST_CASE("vtp: arcs with what lies on either side, and feature lines") {
  const test::LabelledCube cube;
  const test::ProgramFolder dir("vtp");
  write_network_vtp(dir / "network.vtp", cube.handover);
  const Vtp vtp(dir / "network.vtp");
  CHECK(vtp.attribute("<Piece", "NumberOfLines") == "12");
  CHECK(vtp.attribute("<Piece", "NumberOfPoints") == "36");
  const auto kind = vtp.array<std::int32_t>("kind"), left = vtp.array<std::int32_t>("left"),
             right = vtp.array<std::int32_t>("right"), node = vtp.array<std::int32_t>("node");
  const auto offset = vtp.array<std::int64_t>("offsets");
  const auto length = vtp.array<double>("length"), point = vtp.array<double>("Points");
  std::set<std::pair<int, int>> pairs;
  for (std::size_t a = 0; a < 12; ++a) {
    CHECK(kind[a] == 2);
    CHECK(offset[a] == static_cast<std::int64_t>(3 * a + 3));
    CHECK(length[a] == Approx(3));
    pairs.insert(std::minmax(left[a], right[a]));
    CHECK(node[3 * a] >= 0);
    CHECK(node[3 * a + 1] == -1);
    // Seen from outside the left patch is on the left of the arc.
    const auto at = [&](std::size_t i) {
      return Vec3(point[9 * a + 3 * i], point[9 * a + 3 * i + 1], point[9 * a + 3 * i + 2]);
    };
    const Vec3 middle = test::LabelledCube::kCorner + Vec3(1.5, 1.5, 1.5), out = at(1) - middle;
    Vec3 of_left = Vec3::Zero();
    for (Index f = 0; f < 48; ++f)
      if (static_cast<int>(cube.handover.input_patch[f]) == left[a])
        of_left += test::point(cube.soup, cube.soup.corner[3 * f]) / 8;
    CHECK(out.cross(at(2) - at(0)).dot(of_left - at(1)) > 0);
  }
  CHECK(pairs.size() == 12);

  write_features_vtp(dir / "features.vtp", cube.features);
  const Vtp features(dir / "features.vtp");
  CHECK(features.array<std::int32_t>("chosen") == std::vector<std::int32_t>{0, 1});
  CHECK(features.array<std::int64_t>("offsets") == std::vector<std::int64_t>{2, 5});
  CHECK(features.array<double>("T") == std::vector<double>{9, -1});
  CHECK(features.array<double>("radius") == std::vector<double>{.1, .2, 0, 0, 0});
}

TEST_CASE("glb: chunks, patches and curves in place, normals outwards") {
  const test::LabelledCube cube;
  const test::ProgramFolder dir("glb");
  write_layout_glb(Work(), dir / "layout.glb", cube.handover);
  const std::string file = test::file_text(dir / "layout.glb");
  const auto word = [&](std::size_t at) {
    std::uint32_t w = 0;
    std::memcpy(&w, file.data() + at, 4);
    return w;
  };
  CHECK(file.substr(0, 4) == "glTF");
  CHECK(word(4) == 2);
  CHECK(word(8) == file.size());
  CHECK(file.substr(16, 4) == "JSON");
  const std::size_t json_bytes = word(12), data = 20 + json_bytes + 8;
  CHECK(json_bytes % 4 == 0);
  CHECK(file.substr(data - 4, 4) == std::string("BIN\0", 4));
  const nlohmann::json root = nlohmann::json::parse(file.substr(20, json_bytes));
  CHECK(root["buffers"][0]["byteLength"] == word(data - 8));
  const auto begin = [&](const nlohmann::json& accessor) {
    return data + root["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteOffset"].get<std::size_t>() +
           accessor["byteOffset"].get<std::size_t>();
  };
  const auto vec3 = [&](std::size_t at) {
    float f[3];
    std::memcpy(f, file.data() + at, 12);
    return Vec3(f[0], f[1], f[2]);
  };
  const auto& moved = root["nodes"][0]["translation"];
  const Vec3 centre(moved[0], moved[1], moved[2]);
  CHECK((centre - test::LabelledCube::kCorner - Vec3(1.5, 1.5, 1.5)).norm() < 1e-12);
  const auto& primitives = root["meshes"][0]["primitives"];
  REQUIRE(primitives.size() == 6);
  CHECK(root["materials"][3]["name"] == "patch_3");
  for (const auto& primitive : primitives) {
    const auto& place = root["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    const auto& normal = root["accessors"][primitive["attributes"]["NORMAL"].get<std::size_t>()];
    const auto& corner = root["accessors"][primitive["indices"].get<std::size_t>()];
    CHECK(place["count"] == 9);
    CHECK(corner["count"] == 24);
    Real extent = 0;
    for (std::size_t i = 0; i < 3; ++i) extent += place["max"][i].get<Real>() - place["min"][i].get<Real>();
    CHECK(extent == Approx(6));  // a square of side 3
    for (std::size_t t = 0; t < 8; ++t) {
      Vec3 p[3], n = Vec3::Zero();
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t v = word(begin(corner) + 12 * t + 4 * i);
        REQUIRE(v < 9);
        p[i] = vec3(begin(place) + 12 * v), n += vec3(begin(normal) + 12 * v) / 3;
      }
      const Vec3 across = (p[1] - p[0]).cross(p[2] - p[0]);
      CHECK(across.dot(p[0]) > 0);  // outwards
      CHECK(across.normalized().dot(n) == Approx(1));
    }
  }
  const auto& curves = root["meshes"][1]["primitives"];
  REQUIRE(curves.size() == 1);
  CHECK(curves[0]["mode"] == 1);
  CHECK(root["accessors"][curves[0]["indices"].get<std::size_t>()]["count"] == 48);
}

TEST_CASE("VTK and Assimp read the files, where they are installed") {
  const test::LabelledCube cube;
  const test::ProgramFolder dir("readers");
  write_patches_vtp(dir / "patches.vtp", cube.handover);
  write_network_vtp(dir / "network.vtp", cube.handover);
  write_layout_glb(Work(), dir / "layout.glb", cube.handover);
  write_patches_obj(Work(), dir / "patches.obj", cube.handover);
  write_patches_mtl(dir / "patches.mtl", cube.handover);
  if (has("/usr/bin/python3 -c 'import vtkmodules.vtkIOXML'")) {
    const std::string script =
        "import sys; from vtkmodules.vtkIOXML import vtkXMLPolyDataReader as R\n"
        "def read(name):\n r = R(); r.SetFileName(sys.argv[1] + name); r.Update(); return r.GetOutput()\n"
        "p, n = read('patches.vtp'), read('network.vtp')\n"
        "ids = p.GetCellData().GetArray('patch_id')\n"
        "assert p.GetNumberOfPoints() == 26 and p.GetNumberOfPolys() == 48\n"
        "assert sorted(set(ids.GetValue(i) for i in range(48))) == list(range(6))\n"
        "assert n.GetNumberOfLines() == 12 and all(n.GetCell(i).GetNumberOfPoints() == 3 for i in range(12))\n"
        "assert p.GetBounds() == n.GetBounds() == (10, 13, 20, 23, 30, 33)\n";
    std::ofstream(dir / "read.py") << script;
    CHECK(std::system(("/usr/bin/python3 '" + (dir / "read.py") + "' '" + (dir / "") + "'").c_str()) == 0);
  } else {
    MESSAGE("python3-vtk9 is not installed: .vtp not read by VTK");
  }
  if (has("command -v assimp")) {
    for (const char* name : {"layout.glb", "patches.obj"}) {
      CHECK(std::system(("assimp info '" + (dir / name) + "' > '" + (dir / "info") + "'").c_str()) == 0);
      const std::string info = test::file_text(dir / "info");
      CHECK(info.find(std::string(name) == "layout.glb" ? "Meshes:             7" : "Meshes:             6") !=
            std::string::npos);
    }
  } else {
    MESSAGE("assimp-utils is not installed: .glb and .obj not read by Assimp");
  }
}
