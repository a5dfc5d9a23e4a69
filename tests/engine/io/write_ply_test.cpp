#include "engine/io/write_ply.h"

#include <limits>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "engine/data/curve_network.h"
#include "engine/io/read_mesh.h"
#include "tests/engine/io/io_support.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

// A closed surface: a bent sheet would do, but OpenMesh then also sees a manifold without border.
Soup octahedron_like(Index rings) {
  Soup soup;
  const Index around = 60;
  for (Index r = 0; r < rings; ++r)
    for (Index a = 0; a < around; ++a) {
      const Real angle = 6.283185307179586 * a / around, height = (r + 0.5) / rings * 2 - 1;
      soup.x.push_back(std::sqrt(1 - height * height) * std::cos(angle));
      soup.y.push_back(std::sqrt(1 - height * height) * std::sin(angle));
      soup.z.push_back(height);
    }
  const Index south = soup.vertex_count(), north = south + 1;
  soup.x.insert(soup.x.end(), {0, 0}), soup.y.insert(soup.y.end(), {0, 0}), soup.z.insert(soup.z.end(), {-1, 1});
  for (Index a = 0; a < around; ++a) {
    const Index b = (a + 1) % around, last = (rings - 1) * around;
    soup.corner.insert(soup.corner.end(), {south, b, a, north, last + a, last + b});
    for (Index r = 0; r + 1 < rings; ++r) {
      const Index v = r * around, w = v + around;
      soup.corner.insert(soup.corner.end(), {v + a, v + b, w + a, v + b, w + b, w + a});
    }
  }
  return soup;
}

}  // namespace

TEST_CASE("what is written reads back, in double exactly and in float as floats") {
  const TemporaryFolder folder;
  const Soup soup = octahedron_like(150);
  PlyFile fine, coarse;
  fine.element("vertex", soup.vertex_count()).xyz<double>(soup.x, soup.y, soup.z);
  fine.element("face", soup.face_count()).triangles(soup.corner);
  write_ply(Work{}, folder / "fine.ply", fine);
  coarse.comment("two lines\nin one");
  coarse.element("vertex", soup.vertex_count()).xyz<float>(soup.x, soup.y, soup.z);
  coarse.element("face", soup.face_count()).triangles(soup.corner);
  write_ply(Work{}, folder / "coarse.ply", coarse);

  const Soup exact = read_mesh(Work{}, folder / "fine.ply");
  CHECK(exact.x == soup.x);
  CHECK(exact.y == soup.y);
  CHECK(exact.z == soup.z);
  CHECK(exact.corner == soup.corner);
  CHECK(exact.source_face.empty());
  const Soup rounded = read_mesh(Work{}, folder / "coarse.ply");
  bool same = rounded.corner == soup.corner && rounded.x.size() == soup.x.size();
  for (std::size_t v = 0; v < soup.x.size(); ++v)
    same &= rounded.y[v] == static_cast<double>(static_cast<float>(soup.y[v]));
  CHECK(same);
  CHECK(folder.entry_count() == 2);
}

TEST_CASE("another reader sees the same mesh and the same properties") {
  const TemporaryFolder folder;
  const Soup soup = octahedron_like(40);
  std::vector<Index> patch(soup.face_count()), source(soup.face_count());
  for (Index f = 0; f < soup.face_count(); ++f) patch[f] = f % 17, source[f] = f / 2;
  PlyFile ply;
  ply.comment("patches of a test");
  ply.element("vertex", soup.vertex_count()).xyz<float>(soup.x, soup.y, soup.z);
  ply.element("face", soup.face_count())
      .triangles(soup.corner)
      .column<std::int32_t>("patch", patch)
      .column<std::uint8_t>("red", [&](std::size_t f) { return 10 * patch[f]; })
      .column<std::uint8_t>("green", [](std::size_t f) { return f % 256; })
      .column<std::uint8_t>("blue", [](std::size_t) { return 7; })
      .column<std::int32_t>("source_face", source);
  write_ply(Work{}, folder / "patches.ply", ply);

  OpenMesh::TriMesh_ArrayKernelT<> mesh;
  mesh.request_face_colors();
  OpenMesh::IO::Options options(OpenMesh::IO::Options::FaceColor | OpenMesh::IO::Options::Custom);
  REQUIRE(OpenMesh::IO::read_mesh(mesh, (folder / "patches.ply").string(), options));
  REQUIRE(mesh.n_vertices() == soup.vertex_count());
  REQUIRE(mesh.n_faces() == soup.face_count());
  bool same = true;
  for (const auto v : mesh.vertices()) {
    const auto i = static_cast<std::size_t>(v.idx());
    same &= mesh.point(v)[0] == static_cast<float>(soup.x[i]) && mesh.point(v)[2] == static_cast<float>(soup.z[i]);
  }
  CHECK(same);
  OpenMesh::FPropHandleT<int> patch_of, source_of;
  REQUIRE(mesh.get_property_handle(patch_of, "patch"));
  REQUIRE(mesh.get_property_handle(source_of, "source_face"));
  for (const auto f : mesh.faces()) {
    const auto i = static_cast<std::size_t>(f.idx());
    std::vector<Index> corners;
    for (const auto v : mesh.fv_range(f)) corners.push_back(static_cast<Index>(v.idx()));
    std::rotate(corners.begin(), std::find(corners.begin(), corners.end(), soup.corner[3 * i]), corners.end());
    same &= corners == std::vector<Index>(soup.corner.begin() + static_cast<std::ptrdiff_t>(3 * i),
                                          soup.corner.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    same &= mesh.property(patch_of, f) == static_cast<int>(patch[i]);
    same &= mesh.property(source_of, f) == static_cast<int>(source[i]);
  }
  CHECK(same);
}

TEST_CASE("the bytes are those of the format") {
  const TemporaryFolder folder;
  const std::vector<Real> x{1, 2}, y{0, 0}, z{0, -1};
  const std::vector<CurveKind> kind{CurveKind::subdivision};
  PlyFile ply;
  ply.comment("a network");
  ply.element("vertex", 2).xyz<float>(x, y, z);
  ply.element("edge", 1)
      .column<std::int32_t>("vertex1", [](std::size_t) { return 0u; })
      .column<std::int32_t>("vertex2", [](std::size_t) { return 1u; })
      .column<std::int32_t>("kind", kind);
  write_ply(Work{}, folder / "network.ply", ply);
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment a network\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\nelement edge 1\nproperty int vertex1\nproperty int vertex2\nproperty int kind\nend_header\n";
  const std::string body(
      "\0\0\x80\x3f\0\0\0\0\0\0\0\0"
      "\0\0\0\x40\0\0\0\0\0\0\x80\xbf"
      "\0\0\0\0\1\0\0\0\5\0\0\0",
      36);
  CHECK(get_file(folder / "network.ply") == header + body);
}

TEST_CASE("values that are not finite or do not fit are refused and leave the earlier file") {
  const TemporaryFolder folder;
  put_file(folder / "a.ply", "earlier");
  const auto refused = [&](const PlyFile& ply, Index element) {
    const auto error = error_of([&] { write_ply(Work{}, folder / "a.ply", ply); });
    REQUIRE(error);
    CHECK(error->code() == ErrorCode::numeric);
    CHECK(error->element() == element);
    CHECK(mentions(error, "a.ply"));
    CHECK(get_file(folder / "a.ply") == "earlier");
    CHECK(folder.entry_count() == 1);
  };
  const std::size_t n = 10000;  // more than one block
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::vector<double> values(n, 0.5);
    values[7777] = values[9999] = bad;
    PlyFile ply;
    ply.element("vertex", n).column<double>("kmax", values);
    refused(ply, 7777);
  }
  PlyFile narrow, id, colour, corner;
  narrow.element("vertex", n).column<float>("x", [](std::size_t i) { return i == 5000 ? 1e39 : 0.0; });
  refused(narrow, 5000);
  id.element("face", n).column<std::int32_t>("patch", [](std::size_t i) { return i == 3 ? kNone : Index{1}; });
  refused(id, 3);
  colour.element("face", n).column<std::uint8_t>("red", [](std::size_t i) { return i == 9 ? 256 : 255; });
  refused(colour, 9);
  const std::vector<Index> corners{0, 1, 2, 0, 1, kNone};
  corner.element("face", 2).triangles(corners);
  refused(corner, 1);
}

TEST_CASE("a column of the wrong length is a mistake of the program") {
  const std::vector<Real> three(3);
  const std::vector<Index> five(5);
  CHECK(error_of([&] { PlyFile().element("vertex", 4).column<double>("x", three); })->code() == ErrorCode::internal);
  CHECK(error_of([&] { PlyFile().element("face", 2).triangles(five); })->code() == ErrorCode::internal);
}

TEST_CASE("a place that cannot be written is named") {
  const TemporaryFolder folder;
  PlyFile ply;
  ply.element("vertex", 0);
  for (const auto& path : {folder / "missing" / "a.ply", folder.path(), std::filesystem::path("/dev/null")}) {
    const auto error = error_of([&] { write_ply(Work{}, path, ply); });
    REQUIRE(error);
    CHECK(error->code() == ErrorCode::write_failed);
    CHECK(mentions(error, path.string()));
  }
}

TEST_CASE("a full disk is an error, not a short file" * doctest::skip(!std::filesystem::exists("/dev/full"))) {
  // A file system that is full cannot be made here; the device stands in for it behind a link, which is not followed to
  // anything but a regular file.
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "full.ply");
  PlyFile ply;
  ply.element("vertex", 1).column<double>("x", [](std::size_t) { return 1; });
  CHECK(error_of([&] { write_ply(Work{}, folder / "full.ply", ply); })->code() == ErrorCode::write_failed);
}

TEST_CASE("a cancelled run leaves nothing") {
  const TemporaryFolder folder;
  const std::atomic<bool> cancel{true};
  PlyFile ply;
  ply.element("vertex", 5).column<double>("x", [](std::size_t) { return 1; });
  const auto error = error_of([&] { write_ply(Work(&cancel, nullptr, Order::fixed), folder / "a.ply", ply); });
  CHECK(error->code() == ErrorCode::cancelled);
  CHECK(folder.entry_count() == 0);
}
