// Files that are wrong in every way we know: made here, and those of the development data where they are at hand.
// Taken are files that are read and become a surface.
#include <algorithm>
#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include <doctest/doctest.h>
#include <sys/resource.h>

#include "engine/io/read_mesh.h"
#include "graph/stages.h"

using namespace intarsia;
namespace fs = std::filesystem;

namespace {

enum class Fate { reject, accept, any };

struct BadFile {
  const char* name;
  Fate fate;
  std::string bytes;
};

// Nothing, or why it was refused.
std::string refusal(const std::function<Soup()>& read) {
  try {
    const Soup soup = read();
    graph::mesh_to_surface(Work{}, soup, {});
    return {};
  } catch (const Error& e) {
    CHECK((e.code() == ErrorCode::bad_file || e.code() == ErrorCode::rejected || e.code() == ErrorCode::too_large));
    return e.what();
  }
}

void check_fate(const std::string& name, Fate fate, const std::string& reason) {
  CAPTURE(name);
  CAPTURE(reason);
  if (fate == Fate::reject) CHECK_FALSE(reason.empty());
  if (fate == Fate::accept) CHECK(reason.empty());
}

constexpr const char* kTop = "ply\nformat ascii 1.0\n";
constexpr const char* kVertex = "property float x\nproperty float y\nproperty float z\n";
constexpr const char* kList = "property list uchar int vertex_indices\n";

std::string ply(std::uint64_t vertices, std::uint64_t faces, const std::string& body, const std::string& top = kTop) {
  return top + "element vertex " + std::to_string(vertices) + "\n" + kVertex + "element face " + std::to_string(faces) +
         "\n" + kList + "end_header\n" + body;
}

const std::string kPoints = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string kFaces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::string scaled_points(const std::string& unit, const std::string& zero) {
  return replaced(replaced(replaced(kPoints, "1", "U"), "0", zero), "U", unit);
}

std::vector<BadFile> made() {
  const std::string good = ply(4, 4, kPoints + kFaces), binary = "ply\nformat binary_little_endian 1.0\n";
  std::string stl(84, 0);
  stl[80] = 1;
  const std::string doubles = replaced(good, "float", "double");
  return {
      {"empty.ply", Fate::reject, ""},
      {"no-end-header.ply", Fate::reject, good.substr(0, good.find("end_header"))},
      {"truncated-binary.ply", Fate::reject, ply(4, 4, std::string(70, 0), binary)},
      {"truncated-ascii.ply", Fate::reject, good.substr(0, good.find("0 1 0"))},
      {"nan.ply", Fate::reject, replaced(good, "1 0 0", "1 nan 0")},
      {"infinite.ply", Fate::reject, replaced(good, "1 0 0", "1e999 0 0")},
      {"index-too-big.ply", Fate::reject, replaced(good, "3 1 2 3", "3 1 2 4")},
      {"index-negative.ply", Fate::reject, replaced(good, "3 1 2 3", "3 1 2 -1")},
      {"no-faces.ply", Fate::reject, ply(4, 0, kPoints)},
      {"header-count-high.ply", Fate::reject, ply(4, 20, kPoints + kFaces)},
      {"header-count-low.ply", Fate::reject, ply(4, 2, kPoints + kFaces)},
      {"huge-counts.ply", Fate::reject, ply(4'000'000'000, 4'000'000'000, kPoints + kFaces)},
      {"huge-counts-binary.ply", Fate::reject, ply(4'000'000'000, 4'000'000'000, std::string(100, 0), binary)},
      {"count-overflow.ply", Fate::reject, ply(~std::uint64_t{0} / 2, ~std::uint64_t{0} / 2, kPoints, binary)},
      {"huge-list.ply", Fate::reject, replaced(good, "3 1 2 3", "4000000000 1 2 3")},
      {"huge-list-binary.ply", Fate::reject,
       replaced(ply(4, 4, std::string(48, 0) + std::string(60, '\xff'), binary), "uchar int", "uint int")},
      {"element-of-nothing.ply", Fate::accept,
       replaced(good, "element face", "element ghost 99999999999\nelement face")},
      {"list-of-floats.ply", Fate::reject, replaced(good, "uchar int", "uchar float")},
      {"count-of-floats.ply", Fate::reject, replaced(good, "uchar int", "float int")},
      {"list-coordinate.ply", Fate::reject, replaced(good, "property float y", "property list uchar float y")},
      {"no-z.ply", Fate::reject, replaced(good, "property float z\n", "")},
      {"foreign-decimal-comma.ply", Fate::reject, replaced(good, "0 0 1\n", "0 0 1,5\n")},
      {"duplicate-faces.ply", Fate::accept, ply(4, 8, kPoints + kFaces + kFaces)},
      {"bowtie.ply", Fate::accept,
       ply(7, 8, kPoints + "0 0 -1\n-1 0 0\n0 -1 0\n" + kFaces + "3 0 4 5\n3 0 5 6\n3 0 6 4\n3 4 6 5\n")},
      {"edge-three-faces.ply", Fate::accept,
       ply(5, 3, "0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n")},
      {"isolated-vertices.ply", Fate::accept, ply(5, 4, kPoints + "900 900 900\n" + kFaces)},
      {"crlf.ply", Fate::accept, replaced(good, "\n", "\r\n")},
      {"old-line-ends.ply", Fate::accept, replaced(good, "\n", "\r")},
      {"offset.ply", Fate::any, replaced(doubles, kPoints, scaled_points("100000001", "100000000"))},
      {"tiny.ply", Fate::accept, replaced(good, kPoints, scaled_points("1e-8", "0"))},
      {"collinear.ply", Fate::reject, ply(4, 2, "0 0 0\n1 0 0\n2 0 0\n3 0 0\n3 0 1 2\n3 1 2 3\n")},
      {"one-point.ply", Fate::reject, ply(3, 1, "1 1 1\n1 1 1\n1 1 1\n3 0 1 2\n")},
      {"mixed-orientation.ply", Fate::accept, replaced(good, "3 0 1 3", "3 0 3 1")},
      {"strip.ply", Fate::accept,
       replaced(ply(4, 1, kPoints + "6 0 1 2 3 0 1\n"), "element face", "element tristrips")},
      {"polygon.ply", Fate::accept, ply(4, 1, "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")},
      {"two-corners.ply", Fate::any, ply(4, 5, kPoints + kFaces + "2 0 1\n")},
      {"negative-indices.obj", Fate::accept, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n"},
      {"index-zero.obj", Fate::reject, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"},
      {"index-too-far-back.obj", Fate::reject, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -4 -2 -1\n"},
      {"quads.obj", Fate::accept, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n"},
      {"two-coordinates.obj", Fate::reject, "v 0 0\nv 1 0\nv 0 1\nf 1 2 3\n"},
      {"huge-index.obj", Fate::reject, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n"},
      {"huge-counts.off", Fate::reject, "OFF\n4000000000 4000000000 0\n0 0 0\n"},
      {"huge-polygon.off", Fate::reject, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n"},
      {"binary.off", Fate::reject, "OFF BINARY\n"},
      {"count-one-nothing.stl", Fate::reject, stl},
      {"huge-count.stl", Fate::reject, stl.substr(0, 80) + "\xff\xff\xff\xff" + std::string(50, 0)},
      {"cut.stl", Fate::reject, "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"},
      {"unwelded.stl", Fate::accept,
       "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
       "facet normal 0 0 0\nouter loop\nvertex 1 0 -0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"},
  };
}

long resident_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

}  // namespace

TEST_CASE("files that lie are refused, files that are only odd are taken, and neither costs memory") {
  const std::vector<BadFile> files = made();
  const long before = resident_kilobytes();
  for (const BadFile& file : files)
    check_fate(file.name, file.fate, refusal([&] { return read_mesh(Work{}, file.name, file.bytes); }));
  // The largest of these files has a few hundred bytes; threads and the first use of libraries take what they take.
  CHECK(resident_kilobytes() - before < 64 * 1024);
}

TEST_CASE("a locale with decimal commas changes nothing") {
  const char* const commas[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "C"};
  for (const char* name : commas)
    if (std::setlocale(LC_ALL, name)) break;
  CHECK(read_mesh(Work{}, "a.obj", "v 0.5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").x[0] == 0.5);
  CHECK(read_mesh(Work{}, "a.off", "OFF\n3 1 0\n0.5 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").x[0] == 0.5);
  CHECK(read_mesh(Work{}, "a.ply", ply(4, 4, "0.5" + kPoints.substr(1) + kFaces)).x[0] == 0.5);
  std::setlocale(LC_ALL, "C");
}

// The folder of INTARSIA_BAD_MESHES, or that of the development data beside the sources; what is expected of each file
// stands in the table of the README beside it or above it: | file | reject, accept or any | ...
TEST_CASE("every bad file of the development data has the fate its README foretells") {
  const char* given = std::getenv("INTARSIA_BAD_MESHES");
  const fs::path folder = given ? fs::path(given) : fs::path(INTARSIA_SOURCE_DIR) / ".." / "shared" / "data" / "bad";
  if (!fs::exists(folder)) return;
  const std::map<std::string, Fate> fates = {{"reject", Fate::reject}, {"accept", Fate::accept}, {"any", Fate::any}};
  std::size_t judged = 0;
  for (const fs::path& readme : {folder / "README.md", folder / ".." / "README.md"}) {
    std::ifstream in(readme);
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(replaced(line, "|", " "));
      std::string name, fate;
      if (line.rfind("| ", 0) != 0 || !(words >> name >> fate) || !fates.contains(fate)) continue;
      if (!fs::exists(folder / name)) continue;
      check_fate(name, fates.at(fate), refusal([&] { return read_mesh(Work{}, folder / name); }));
      ++judged;
    }
  }
  CHECK(judged == static_cast<std::size_t>(std::count_if(fs::directory_iterator(folder), fs::directory_iterator{},
                                                         [](const auto& e) { return e.path().extension() != ".md"; })));
}
