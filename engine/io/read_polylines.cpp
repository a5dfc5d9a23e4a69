#include "engine/io/read_polylines.h"

#include <cmath>
#include <string>

#include "engine/base/error.h"
#include "engine/io/file_bytes.h"
#include "engine/io/text_scanner.h"

namespace intarsia {
namespace {

using Polylines = std::vector<std::vector<Vec3>>;

class PolylineReader {
 public:
  PolylineReader(const Work& work, const std::filesystem::path& path, std::string_view text)
      : work_(work), path_(path), text_(text) {}

  Polylines read_obj() {
    each_line([&](TextScanner& words, std::string_view first) {
      if (first == "v") {
        vertex_.push_back(point(words));
      } else if (first == "l") {
        std::vector<Vec3> polyline;
        for (std::string_view word = words.word(); !word.empty(); word = words.word())
          polyline.push_back(vertex_[index(word.substr(0, word.find('/')))]);
        add(std::move(polyline));
      }
    });
    return finish("lines ('l')");
  }

  Polylines read_text() {
    each_line([&](TextScanner& words, std::string_view first) {
      std::int64_t count = 0;
      // a point takes six characters at least
      if (!parse_integer(first, count) || count < 2 || static_cast<std::uint64_t>(count) > words.left() / 6 + 1)
        fail("does not begin with the number of its points");
      std::vector<Vec3> polyline;
      for (std::int64_t i = 0; i < count; ++i) polyline.push_back(point(words));
      add(std::move(polyline));
    });
    return finish("polylines");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::bad_file, path_.string() + ": line " + std::to_string(line_) + " " + what);
  }

  template <class Visit>
  void each_line(const Visit& visit) {
    TextScanner lines(text_);
    while (!lines.at_end()) {
      if (line_++ % 4096 == 0) work_.check();
      const std::string_view line = lines.line();
      TextScanner words(line.substr(0, line.find('#')));
      const std::string_view first = words.word();
      if (!first.empty()) visit(words, first);
    }
  }

  Vec3 point(TextScanner& words) const {
    Vec3 p;
    for (int i = 0; i < 3; ++i)
      if (!parse_real(words.word(), p[i]) || !std::isfinite(p[i])) fail("lacks a coordinate that is a finite number");
    return p;
  }

  std::size_t index(std::string_view word) const {
    const auto count = static_cast<std::int64_t>(vertex_.size());
    std::int64_t i = 0;
    if (!parse_integer(word, i) || i == 0 || i > count || i < -count)
      fail("names vertex '" + std::string(word) + "' of " + std::to_string(count));
    return static_cast<std::size_t>(i > 0 ? i - 1 : count + i);
  }

  void add(std::vector<Vec3> polyline) {
    if (polyline.size() < 2) fail("is a curve of fewer than two points");
    found_.push_back(std::move(polyline));
  }

  Polylines finish(const char* what) {
    if (found_.empty()) throw Error(ErrorCode::bad_file, path_.string() + ": has no " + what);
    return std::move(found_);
  }

  const Work& work_;
  const std::filesystem::path& path_;
  std::string_view text_;
  std::size_t line_ = 0;
  std::vector<Vec3> vertex_;
  Polylines found_;
};

}  // namespace

Polylines read_polylines(const Work& work, const std::filesystem::path& path, std::string_view text) {
  PolylineReader reader(work, path, text);
  const std::string ending = path.extension().string();
  if (ending == ".obj" || ending == ".OBJ") return reader.read_obj();
  if (ending == ".txt") return reader.read_text();
  throw Error(ErrorCode::bad_file, path.string() + ": curves come as .obj with lines, or as .polylines.txt");
}

Polylines read_polylines(const Work& work, const std::filesystem::path& path) {
  const FileBytes file(work, path);
  return read_polylines(work, path, file.view());
}

}  // namespace intarsia
