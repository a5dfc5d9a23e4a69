#include "engine/io/read_stl.h"

#include <algorithm>
#include <cstring>

#include "engine/io/face_collector.h"
#include "engine/io/file_error.h"
#include "engine/io/text_scanner.h"
#include "engine/io/weld.h"
#include "engine/parallel/for_each.h"
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

using Point = std::array<Real, 3>;

class AsciiReader {
 public:
  // inside: the text begins inside of a solid.
  AsciiReader(const std::filesystem::path& path, std::string_view text, bool inside = false)
      : path_(path), scanner_(text), inside_(inside) {}

  bool is_inside() const { return inside_; }
  // Reads to the end of the text.
  std::vector<Point> run(const Work& work) {
    for (;;) {
      const std::string word = lower(scanner_.word());
      if (word.empty()) break;
      if (word == "solid" && !inside_) {
        inside_ = true;
        scanner_.line();
      } else if (word == "endsolid" && inside_) {
        inside_ = false;
        scanner_.line();
      } else if (word == "facet" && inside_) {
        if (triangle_ % 4096 == 0) work.check();
        read_facet();
      } else {
        fail("holds '" + printable(word) + "' where a facet or the end of a solid should be");
      }
    }
    return std::move(point_);
  }
  // Errors: bad_file if the text may not end here.
  void check_end() const {
    if (inside_) fail("ends without 'endsolid' (cut file)");
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
      Point p{};
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
  bool inside_;  // of a solid; a file may hold several, one after the other
  std::vector<Point> point_;
  std::uint64_t triangle_ = 0;
};

// Behind a line that holds nothing but 'endfacet', at or after `from`; the end of the text if there is none.
std::size_t behind_facet(std::string_view text, std::size_t from) {
  constexpr std::string_view kWord = "endfacet";
  for (std::size_t at = text.find(kWord, from); at != std::string_view::npos; at = text.find(kWord, at + 1)) {
    std::size_t before = at, end = at + kWord.size();
    while (before > 0 && (text[before - 1] == ' ' || text[before - 1] == '\t')) --before;
    if (end < text.size() && text[end] == '\r') ++end;
    if (before > 0 && text[before - 1] == '\n' && end < text.size() && text[end] == '\n') return end;
  }
  return text.size();
}

// Reads the text in pieces, side by side, each as if the one before it ended inside of a solid. Nothing if that does
// not hold or anything is wrong.
std::vector<Point> read_pieces(const Work& work, const std::filesystem::path& path, std::string_view file) {
  constexpr std::size_t kPiece = std::size_t{4} << 20;
  const std::size_t pieces = file.size() / kPiece;
  if (pieces < 2) return {};
  std::vector<std::vector<Point>> part(pieces);
  std::vector<std::uint8_t> good(pieces, 0);
  const auto border = [&](std::size_t p) {
    return p == 0 ? 0 : p == pieces ? file.size() : behind_facet(file, p * kPiece);
  };
  for_each(work, Cost::single, pieces, [&](std::size_t p) {
    const std::size_t begin = border(p), end = std::max(begin, border(p + 1));
    try {
      AsciiReader reader(path, file.substr(begin, end - begin), p > 0);
      part[p] = reader.run(work);
      good[p] = reader.is_inside() == (p + 1 < pieces);
    } catch (const Error& e) {
      if (e.code() != ErrorCode::bad_file) throw;
    }
  });
  if (std::count(good.begin(), good.end(), 1) != static_cast<std::ptrdiff_t>(pieces)) return {};
  std::vector<std::size_t> offset(pieces + 1, 0);
  for (std::size_t p = 0; p < pieces; ++p) offset[p + 1] = offset[p] + part[p].size();
  check_triangle_count(path, offset[pieces] / 3);
  std::vector<Point> point(offset[pieces]);
  for_each(work, Cost::single, pieces, [&](std::size_t p) {
    std::copy(part[p].begin(), part[p].end(), point.begin() + static_cast<std::ptrdiff_t>(offset[p]));
    part[p] = {};
  });
  return point;
}

}  // namespace

Soup read_stl(const Work& work, const std::filesystem::path& path, std::string_view file) {
  // Many binary files begin with the word 'solid', too: the size tells.
  const bool sized_as_binary =
      file.size() >= kHeaderBytes && file.size() == kHeaderBytes + kTriangleBytes * binary_triangle_count(file);
  const bool says_solid =
      TextScanner(file.substr(0, 256)).word() == "solid" && file.substr(0, 1024).find('\0') == std::string_view::npos;
  if (sized_as_binary || !says_solid) return read_binary(work, path, file);
  std::vector<Point> points = read_pieces(work, path, file);
  if (points.empty()) {
    AsciiReader reader(path, file);
    points = reader.run(work);
    reader.check_end();
  }
  Soup soup;
  weld(
      work, static_cast<Index>(points.size()), [&](Index c) { return points[c]; }, soup);
  return soup;
}

}  // namespace intarsia
