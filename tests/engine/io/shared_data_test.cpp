// Real and broken files of the development data, where they are at hand.
#include <map>

#include <doctest/doctest.h>

#include "engine/io/read_mesh.h"
#include "tests/engine/io/io_support.h"

using namespace intarsia;
using namespace intarsia::test;
namespace fs = std::filesystem;

namespace {

const fs::path kData = fs::path(INTARSIA_SOURCE_DIR) / ".." / "shared" / "data";

struct Counts {
  Index vertices, triangles;
};

}  // namespace

TEST_CASE("every mesh of the development data has the published counts" *
          doctest::skip(!fs::exists(kData / "meshes"))) {
  const std::map<std::string, Counts> known = {
      {"rocker-arm", {10044, 20088}},  {"fandisk", {6475, 12946}},         {"fandisk-noisy", {6475, 12946}},
      {"octa-flower", {17641, 35278}}, {"igea", {134345, 268686}},         {"bunny", {35947, 69451}},
      {"dragon", {437645, 871414}},    {"iguana-skull", {388793, 781672}}, {"macaque-brain", {167882, 336528}},
      {"blade", {99519, 199034}},      {"joint", {20902, 41808}},          {"botijo", {41158, 82332}},
      {"fertility", {13971, 27954}},   {"armadillo", {43243, 86482}},      {"face", {25905, 51712}},
      {"bracket", {29999, 60066}},     {"crank-arm", {26197, 52402}},      {"pump-top", {98593, 197202}}};
  std::size_t read = 0;
  for (const auto& entry : fs::directory_iterator(kData / "meshes")) {
    if (entry.path().extension() != ".ply") continue;
    const auto counts = known.find(entry.path().stem().string());
    if (counts == known.end()) continue;
    const Soup soup = read_mesh(Work{}, entry.path());
    CHECK_MESSAGE(soup.vertex_count() == counts->second.vertices, entry.path());
    CHECK_MESSAGE(soup.face_count() == counts->second.triangles, entry.path());
    ++read;
  }
  CHECK(read == known.size());
}

TEST_CASE("every bad file is read or refused cleanly" * doctest::skip(!fs::exists(kData / "bad"))) {
  const std::map<std::string, std::string> must_refuse = {{"made-empty.ply", "empty"},
                                                          {"made-no-end-header.ply", "header"},
                                                          {"made-truncated-binary.ply", "face 5371"},
                                                          {"made-truncated-ascii.ply", "vertex 3384"},
                                                          {"made-nan.ply", "vertex"},
                                                          {"made-index-too-big.ply", "face"},
                                                          {"made-no-faces.ply", "no triangles"},
                                                          {"made-header-count-high.ply", "face 2"},
                                                          {"made-huge-counts.ply", "4000000000"}};
  for (const auto& entry : fs::directory_iterator(kData / "bad")) {
    const std::string name = entry.path().filename().string();
    Soup soup;
    const auto error = error_of([&] { soup = read_mesh(Work{}, entry.path()); });
    const auto reason = must_refuse.find(name);
    CHECK_MESSAGE(error.has_value() == (reason != must_refuse.end()), name);
    if (reason == must_refuse.end()) continue;
    CHECK(error->code() == ErrorCode::bad_file);
    CHECK(mentions(error, name));
    CHECK_MESSAGE(mentions(error, reason->second), error->what());
  }
}

TEST_CASE("the same surface in other clothes" * doctest::skip(!fs::exists(kData / "bad"))) {
  const Soup fandisk = read_mesh(Work{}, kData / "meshes" / "fandisk.ply");
  for (const char* name : {"made-crlf.ply", "made-big-endian.ply", "made-negative-indices.obj"}) {
    const Soup soup = read_mesh(Work{}, kData / "bad" / name);
    CHECK_MESSAGE(soup.corner == fandisk.corner, name);
    REQUIRE(soup.x.size() == fandisk.x.size());
    Real worst = 0;
    for (std::size_t v = 0; v < soup.x.size(); ++v)
      worst = std::max({worst, std::abs(soup.x[v] - fandisk.x[v]), std::abs(soup.y[v] - fandisk.y[v]),
                        std::abs(soup.z[v] - fandisk.z[v])});
    CHECK_MESSAGE(worst < 1e-5, name);
  }
  const Soup stl = read_mesh(Work{}, kData / "bad" / "made-unwelded.stl");
  CHECK(stl.vertex_count() == fandisk.vertex_count());
  CHECK(stl.face_count() == fandisk.face_count());
  bool same = true;  // corner by corner, wherever the welded vertices are numbered
  for (std::size_t c = 0; c < stl.corner.size(); ++c) same &= stl.x[stl.corner[c]] == fandisk.x[fandisk.corner[c]];
  CHECK(same);

  // igea was published as one strip of triangles.
  const Soup igea = read_mesh(Work{}, kData / "meshes" / "igea.ply");
  const Soup strip = read_mesh(Work{}, kData / "bad" / "real-tristrips-igea.ply");
  CHECK(strip.x == igea.x);
  REQUIRE(strip.corner.size() == igea.corner.size());
  const auto turned = [](const Soup& s, std::size_t f) {  // smallest corner first
    std::array<Index, 3> t{s.corner[3 * f], s.corner[3 * f + 1], s.corner[3 * f + 2]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  for (Index f = 0; f < igea.face_count(); ++f) same &= turned(strip, f) == turned(igea, f);
  CHECK(same);
}
