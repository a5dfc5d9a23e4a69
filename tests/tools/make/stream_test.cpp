#include <atomic>
#include <cstring>
#include <fstream>
#include <sstream>

#include <doctest/doctest.h>

#include "tools/make/shape.h"

using namespace intarsia;
using namespace intarsia::tools;

namespace {

struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("make_stream_test-" + std::to_string(std::rand()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path), {}));
  }
};

std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

template <class T>
T take(const std::string& bytes, std::size_t& at) {
  T value;
  REQUIRE(at + sizeof value <= bytes.size());
  std::memcpy(&value, bytes.data() + at, sizeof value);
  at += sizeof value;
  return value;
}

}  // namespace

TEST_CASE("the streamed file holds the mesh made in memory") {
  const Folder folder;
  for (const char* name : {"part", "cylinder"})
    for (const bool wide : {true, false}) {
      MakeOptions o;
      o.shape = name;
      o.triangles = 30'000;
      o.noise_edges = 0.1;
      o.irregularity = 0.3;
      o.double_coordinates = wide;
      const auto path = folder.path / "mesh.ply";
      make_to_file(Work(), o, path);
      CHECK(folder.files() == 1);
      const std::string bytes = contents(path);
      const Soup soup = make_shape(Work(), o);
      const std::string type = wide ? "double" : "float";
      CHECK(bytes.rfind("ply\nformat binary_little_endian 1.0\n", 0) == 0);
      CHECK(bytes.find("element vertex " + std::to_string(soup.vertex_count()) + "\nproperty " + type + " x\n") !=
            std::string::npos);
      CHECK(bytes.find("element face " + std::to_string(soup.face_count()) + "\nproperty list uchar int") !=
            std::string::npos);
      std::size_t at = bytes.find("end_header\n") + 11;
      int wrong = 0;
      for (Index v = 0; v < soup.vertex_count(); ++v)
        for (const Real c : {soup.x[v], soup.y[v], soup.z[v]})
          wrong += wide ? take<double>(bytes, at) != c : take<float>(bytes, at) != static_cast<float>(c);
      for (Index f = 0; f < soup.face_count(); ++f) {
        wrong += take<std::uint8_t>(bytes, at) != 3;
        for (int i = 0; i < 3; ++i)
          wrong += take<std::int32_t>(bytes, at) != static_cast<std::int32_t>(soup.corner[3 * f + i]);
      }
      CHECK(wrong == 0);
      CHECK(at == bytes.size());
    }
}

TEST_CASE("a failed or cancelled file leaves nothing behind, and an older file stays") {
  const Folder folder;
  MakeOptions o;
  o.shape = "sphere";
  o.triangles = 20'000;
  try {
    make_to_file(Work(), o, folder.path / "missing" / "mesh.ply");
    FAIL("wrote into a folder that does not exist");
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::write_failed);
  }
  const auto path = folder.path / "mesh.ply";
  std::ofstream(path) << "old";
  std::atomic<bool> stop{true};
  CHECK_THROWS_AS(make_to_file(Work(&stop, nullptr, Order::fixed), o, path), Error);
  CHECK(contents(path) == "old");
  CHECK(folder.files() == 1);
}
