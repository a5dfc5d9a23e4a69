#include "engine/io/plain_text.h"

#include <algorithm>
#include <limits>
#include <span>

#include "engine/io/face_collector.h"
#include "engine/io/file_error.h"
#include "engine/io/text_scanner.h"

namespace intarsia {
namespace {

// The lines of a file and what both formats share.
class PlainWriter {
 public:
  PlainWriter(const Work& work, const std::filesystem::path& path, std::string_view file)
      : work_(work), path_(path), file_(file) {}

  bool at_end() const { return file_.at_end(); }
  std::string_view line() {
    if (++line_number_ % 4096 == 0) work_.check();
    return file_.line();
  }

  [[noreturn]] void fail(const std::string& what, std::uint64_t element = kNone) const {
    throw_bad_file(path_, "line " + std::to_string(line_number_) + ": " + what,
                   "correct that line or export the mesh again", element);
  }

  void vertex(TextScanner& words, std::string_view prefix) {
    const std::uint64_t id = plain_.x.size();
    plain_.text += prefix;
    for (auto* target : {&plain_.x, &plain_.y, &plain_.z}) {
      const std::string_view word = words.word();
      Real value = 0;
      if (!parse_real(word, value))
        fail("vertex " + std::to_string(id) + " (counted from 0) " +
                 (word.empty() ? "has fewer than three coordinates" : "holds '" + printable(word) + "', not a number"),
             id);
      constexpr Real kMost = std::numeric_limits<float>::max();  // OpenMesh leaves out vertices beyond it
      if (!(value >= -kMost && value <= kMost))
        fail("vertex " + std::to_string(id) + " (counted from 0) has a coordinate that is not a usable number", id);
      target->push_back(value);
    }
    plain_.text += "0 0 0\n";  // the coordinates are kept here, in full precision; OpenMesh numbers the vertices
    check_vertex_count(path_, plain_.x.size());
  }

  // `vertex`: counted from 0; `shown`: as the format has it.
  void face(std::span<const std::int64_t> vertex, std::span<const std::int64_t> shown, std::string_view prefix) {
    const std::uint64_t id = plain_.face_count++;
    if (vertex.size() < 3 || repeats(vertex)) {
      const std::size_t begin = plain_.odd_corner.size();
      plain_.odd_corner.insert(plain_.odd_corner.end(), vertex.begin(), vertex.end());
      plain_.odd_face.push_back({id, begin, plain_.odd_corner.size()});
      return;
    }
    plain_.text += prefix;
    for (const std::int64_t c : shown) {
      if (c < -kMostCorner || c > kMostCorner)
        fail("face " + std::to_string(id) + " (counted from 0) names vertex " + std::to_string(c), id);
      plain_.text += ' ';
      plain_.text += std::to_string(c);
    }
    plain_.text += '\n';
  }

  std::int64_t vertex_count() const { return static_cast<std::int64_t>(plain_.x.size()); }
  std::uint64_t face_count() const { return plain_.face_count; }
  PlainText take() { return std::move(plain_); }

 private:
  static constexpr std::int64_t kMostCorner = std::numeric_limits<int>::max() - 1;  // OpenMesh numbers with int

  bool repeats(std::span<const std::int64_t> vertex) {
    if (vertex.size() == 3) return vertex[0] == vertex[1] || vertex[1] == vertex[2] || vertex[2] == vertex[0];
    sorted_.assign(vertex.begin(), vertex.end());
    std::sort(sorted_.begin(), sorted_.end());
    return std::adjacent_find(sorted_.begin(), sorted_.end()) != sorted_.end();
  }

  const Work& work_;
  const std::filesystem::path& path_;
  TextScanner file_;
  std::uint64_t line_number_ = 0;
  PlainText plain_;
  std::vector<std::int64_t> sorted_;
};

void obj_face(PlainWriter& writer, TextScanner& words, std::vector<std::int64_t>& corners,
              std::vector<std::int64_t>& vertices) {
  corners.clear();
  vertices.clear();
  for (std::string_view word = words.word(); !word.empty() && word.front() != '#'; word = words.word()) {
    std::int64_t corner = 0;
    if (!parse_integer(word.substr(0, word.find('/')), corner) || corner == 0)
      writer.fail("face " + std::to_string(writer.face_count()) + " (counted from 0) holds '" + printable(word) +
                      "', which names no vertex",
                  writer.face_count());
    corners.push_back(corner);
    vertices.push_back(corner > 0 ? corner - 1 : writer.vertex_count() + corner);
  }
  writer.face(vertices, corners, "f");
}

std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

// The next line with a word, without its comment.
std::string_view off_line(PlainWriter& writer, const std::string& what) {
  while (!writer.at_end()) {
    const std::string_view line = without_comment(writer.line());
    if (!TextScanner(line).word().empty()) return line;
  }
  writer.fail("the file ends before " + what + " (cut file or wrong counts)");
}

// The kinds of OFF that list x y z first on the line of each vertex.
std::size_t off_keyword_length(PlainWriter& writer, std::string_view line) {
  std::string_view rest = line;
  for (const char* part : {"ST", "C", "N"})
    if (rest.substr(0, std::string_view(part).size()) == part) rest.remove_prefix(std::string_view(part).size());
  if (rest.substr(0, 3) != "OFF") writer.fail("does not begin with OFF, COFF, NOFF or STOFF");
  return line.size() - rest.size() + 3;
}

}  // namespace

PlainText plain_obj(const Work& work, const std::filesystem::path& path, std::string_view file) {
  PlainWriter writer(work, path, file);
  std::vector<std::int64_t> corners, vertices;
  std::string joined;
  while (!writer.at_end()) {
    std::string_view line = writer.line();
    const bool comment = TextScanner(line).word().substr(0, 1) == "#";
    if (!comment && !line.empty() && line.back() == '\\') {  // goes on in the next line
      joined.clear();
      while (!line.empty() && line.back() == '\\') {
        joined.append(line.substr(0, line.size() - 1)).push_back(' ');
        line = writer.at_end() ? std::string_view{} : writer.line();
      }
      line = joined.append(line);
    }
    TextScanner words(line);
    const std::string_view keyword = words.word();
    if (keyword == "v")
      writer.vertex(words, "v ");
    else if (keyword == "f" || keyword == "fo")  // fo: the same, from the first version of the format
      obj_face(writer, words, corners, vertices);
  }
  return writer.take();
}

PlainText plain_off(const Work& work, const std::filesystem::path& path, std::string_view file) {
  PlainWriter writer(work, path, file);
  std::string_view line = off_line(writer, "the word OFF");
  const std::size_t indent = line.find_first_not_of(" \t");
  line.remove_prefix(indent);
  line.remove_prefix(off_keyword_length(writer, line));
  if (TextScanner(line).word() == "BINARY") writer.fail("binary OFF is not supported; write it as text or as PLY");
  if (TextScanner(line).word().empty()) line = off_line(writer, "the counts");  // else they stand behind the word
  TextScanner words(line);
  std::int64_t vertices = 0, faces = 0;
  if (!parse_integer(words.word(), vertices) || !parse_integer(words.word(), faces) || vertices < 0 || faces < 0)
    writer.fail("the counts of vertices and faces are not valid");

  for (std::int64_t v = 0; v < vertices; ++v) {
    TextScanner entry(off_line(writer, "vertex " + std::to_string(v) + " of " + std::to_string(vertices)));
    writer.vertex(entry, "");
  }
  std::vector<std::int64_t> corners;
  for (std::int64_t f = 0; f < faces; ++f) {
    TextScanner entry(off_line(writer, "face " + std::to_string(f) + " of " + std::to_string(faces)));
    std::int64_t count = 0;
    if (!parse_integer(entry.word(), count) || count < 0)
      writer.fail("face " + std::to_string(f) + " (counted from 0) has no valid count of corners",
                  static_cast<std::uint64_t>(f));
    corners.clear();
    for (std::int64_t i = 0; i < count; ++i) {
      std::int64_t corner = 0;
      if (!parse_integer(entry.word(), corner))
        writer.fail(
            "face " + std::to_string(f) + " (counted from 0) has fewer corners than its count " + std::to_string(count),
            static_cast<std::uint64_t>(f));
      corners.push_back(corner);
    }
    writer.face(corners, corners, std::to_string(count));
  }
  while (!writer.at_end())
    if (!TextScanner(without_comment(writer.line())).word().empty()) writer.fail("more data than the counts announce");
  PlainText plain = writer.take();
  const std::uint64_t left = plain.face_count - plain.odd_face.size();
  plain.text.insert(0, "OFF\n" + std::to_string(vertices) + " " + std::to_string(left) + " 0\n");
  return plain;
}

}  // namespace intarsia
