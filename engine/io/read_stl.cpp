#include "engine/io/read_stl.h"

#include <algorithm>
#include <cstring>

#include "engine/io/face_collector.h"
#include "engine/io/file_error.h"
#include "engine/io/text_scanner.h"
#include "engine/io/weld.h"
#include "engine/parallel/reduce.h"

namespace intarsia {
namespace {

constexpr std::size_t kHeaderBytes = 84, kTriangleBytes = 50, kPointsBegin = 12;

[[noreturn]] void throw_bad_point(const std::filesystem::path& path, std::uint64_t triangle) {
  throw_bad_file(
      path, "triangle " + std::to_string(triangle) + " (counted from 0) has a coordinate that is not a usable number",
      "remove that triangle or export the mesh again", triangle);
}

void check_triangle_count(const std::filesystem::path& path, std::uint64_t count) {
  if (count > (kNone - 1) / 3)
    throw Error(ErrorCode::too_large, path.string() + ": has " + std::to_string(count) +
                                          " triangles; simplify the mesh or cut it into pieces");
}

std::uint64_t binary_triangle_count(std::string_view file) {
  std::uint32_t count = 0;
  if (file.size() >= kHeaderBytes) std::memcpy(&count, file.data() + kHeaderBytes - 4, 4);
  return count;
}

Soup read_binary(const Work& work, const std::filesystem::path& path, std::string_view file) {
  const std::uint64_t count = binary_triangle_count(file), promised = kHeaderBytes + kTriangleBytes * count;
  const auto is_padding = [](char c) { return c == 0 || is_blank(c); };
  if (file.size() < promised ||
      !std::all_of(file.begin() + static_cast<std::ptrdiff_t>(promised), file.end(), is_padding))
    throw_bad_file(path,
                   "its header announces " + std::to_string(count) + " triangles, which take " +
                       std::to_string(promised) + " bytes, but the file has " + std::to_string(file.size()) +
                       " (cut file, wrong header, or not STL)",
                   kCureExportAgain);
  check_triangle_count(path, count);
  const auto point = [&](Index corner) {
    float p[3];
    std::memcpy(p, file.data() + kHeaderBytes + kTriangleBytes * (corner / 3) + kPointsBegin + 12 * (corner % 3), 12);
    return std::array<Real, 3>{p[0], p[1], p[2]};
  };
  const auto corners = static_cast<Index>(3 * count);
  const Index bad = reduce(
      work, Cost::light, corners, kNone,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
          const auto p = point(static_cast<Index>(c));
          if (!std::all_of(p.begin(), p.end(), is_usable)) return static_cast<Index>(c);
        }
        return kNone;
      },
      [](Index a, Index b) { return std::min(a, b); });
  if (bad != kNone) throw_bad_point(path, bad / 3);
  Soup soup;
  weld(work, corners, point, soup);
  return soup;
}

class AsciiReader {
 public:
  AsciiReader(const std::filesystem::path& path, std::string_view file) : path_(path), scanner_(file) {}

  std::vector<std::array<Real, 3>> run(const Work& work) {
    bool inside = false;  // of a solid; a file may hold several, one after the other
    for (;;) {
      const std::string word = lower(scanner_.word());
      if (word.empty()) break;
      if (word == "solid" && !inside) {
        inside = true;
        scanner_.line();
      } else if (word == "endsolid" && inside) {
        inside = false;
        scanner_.line();
      } else if (word == "facet" && inside) {
        if (triangle_ % 4096 == 0) work.check();
        read_facet();
      } else {
        fail("holds '" + printable(word) + "' where a facet or the end of a solid should be");
      }
    }
    if (inside) fail("ends without 'endsolid' (cut file)");
    return std::move(point_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw_bad_file(path_, what + ", after " + std::to_string(triangle_) + " triangles", kCureExportAgain, triangle_);
  }
  static std::string lower(std::string_view word) {
    std::string text(word.substr(0, 64));
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
  }
  void expect(const char* keyword) {
    const std::string_view word = scanner_.word();
    if (lower(word) != keyword)
      fail(word.empty() ? "ends inside a facet (cut file)"
                        : "holds '" + printable(word) + "' where '" + keyword + "' should be");
  }
  void read_facet() {
    expect("normal");
    for (int i = 0; i < 3; ++i) scanner_.word();  // programs write all kinds of normals; corners give the orientation
    expect("outer");
    expect("loop");
    for (int i = 0; i < 3; ++i) {
      expect("vertex");
      std::array<Real, 3> p{};
      for (Real& value : p) {
        const std::string_view word = scanner_.word();
        if (!parse_real(word, value))
          fail(word.empty() ? "ends inside a facet (cut file)" : "holds '" + printable(word) + "' instead of a number");
        if (!is_usable(value)) throw_bad_point(path_, triangle_);
      }
      point_.push_back(p);
    }
    expect("endloop");
    expect("endfacet");
    check_triangle_count(path_, ++triangle_);
  }

  const std::filesystem::path& path_;
  TextScanner scanner_;
  std::vector<std::array<Real, 3>> point_;
  std::uint64_t triangle_ = 0;
};

}  // namespace

Soup read_stl(const Work& work, const std::filesystem::path& path, std::string_view file) {
  // Many binary files begin with the word 'solid', too: the size tells.
  const bool sized_as_binary =
      file.size() >= kHeaderBytes && file.size() == kHeaderBytes + kTriangleBytes * binary_triangle_count(file);
  const bool says_solid =
      TextScanner(file.substr(0, 256)).word() == "solid" && file.substr(0, 1024).find('\0') == std::string_view::npos;
  if (sized_as_binary || !says_solid) return read_binary(work, path, file);
  const auto points = AsciiReader(path, file).run(work);
  Soup soup;
  weld(
      work, static_cast<Index>(points.size()), [&](Index c) { return points[c]; }, soup);
  return soup;
}

}  // namespace intarsia
