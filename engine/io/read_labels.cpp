#include "engine/io/read_labels.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <numeric>

#include "engine/io/extension.h"
#include "engine/io/file_bytes.h"
#include "engine/io/file_error.h"
#include "engine/io/ply_header.h"
#include "engine/io/text_scanner.h"

namespace intarsia {
namespace {

constexpr const char* kCureLabels = "write one whole number per face";

bool is_ply(std::string_view file) { return TextScanner(file.substr(0, 64)).word() == "ply"; }

// Scalars of the data part of a PLY file, one after the other.
class Values {
 public:
  Values(const std::filesystem::path& path, PlyFormat format, std::string_view body)
      : path_(path), format_(format), body_(body), scanner_(body) {}

  std::int64_t integer(const PlyElement& element, std::uint64_t item, PlyType type) {
    if (format_ == PlyFormat::ascii) {
      const std::string_view word = scanner_.word();
      std::int64_t value = 0;
      if (word.empty()) ends(element, item);
      if (!parse_integer(word, value))
        throw_bad_file(path_, name_of(element, item) + " holds '" + printable(word) + "', which is no whole number",
                       kCureLabels, item);
      return value;
    }
    const std::size_t bytes = size_of(type);
    if (body_.size() - at_ < bytes) ends(element, item);
    const bool is_signed = type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < bytes; ++i) {  // the byte of most weight first
      const std::size_t from = format_ == PlyFormat::big_endian ? i : bytes - 1 - i;
      const auto byte = static_cast<unsigned char>(body_[at_ + from]);
      if (i == 0 && is_signed && byte >= 0x80) bits = ~std::uint64_t{0};
      bits = bits << 8 | byte;
    }
    at_ += bytes;
    return static_cast<std::int64_t>(bits);
  }

  void skip(const PlyElement& element, std::uint64_t item, const PlyProperty& property) {
    std::uint64_t count = 1;
    if (property.is_list) {
      const std::int64_t given = integer(element, item, property.count_type);
      if (given < 0)
        throw_bad_file(path_, name_of(element, item) + " has a list of negative length", kCureExportAgain, item);
      count = static_cast<std::uint64_t>(given);
    }
    if (format_ == PlyFormat::ascii) {
      for (; count > 0; --count)
        if (scanner_.word().empty()) ends(element, item);
      return;
    }
    const std::size_t bytes = size_of(property.type);
    if ((body_.size() - at_) / bytes < count) ends(element, item);
    at_ += count * bytes;
  }

 private:
  static std::string name_of(const PlyElement& element, std::uint64_t item) {
    return printable(element.name) + " " + std::to_string(item) + " (counted from 0)";
  }
  [[noreturn]] void ends(const PlyElement& element, std::uint64_t item) const {
    throw_bad_file(path_, "ends inside " + name_of(element, item) + " of " + std::to_string(element.count),
                   kCureExportAgain, item);
  }

  const std::filesystem::path& path_;
  PlyFormat format_;
  std::string_view body_;
  std::size_t at_ = 0;
  TextScanner scanner_;
};

int checked(const std::filesystem::path& path, std::int64_t value, const std::string& where, std::uint64_t item) {
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    throw_bad_file(path, where + " has the label " + std::to_string(value) + ", which does not fit 32 bits",
                   "number the labels from 0", item);
  return static_cast<int>(value);
}

std::vector<int> read_ply_labels(const Work& work, const std::filesystem::path& path, std::string_view file,
                                 const std::string& name) {
  const PlyHeader header = parse_ply_header(path, file);
  const PlyElement* face = header.find("face");
  if (!face) throw_bad_file(path, "has no faces", "give a mesh whose faces have an integer property '" + name + "'");
  const int at = face->find(name);
  if (at < 0) {
    std::string others;
    for (const PlyProperty& p : face->property) others += (others.empty() ? "" : ", ") + printable(p.name);
    throw_bad_file(path, "its faces have no property '" + name + "' (they have: " + others + ")",
                   "name another property or give labels of their own in a .seg file");
  }
  const auto wanted = static_cast<std::size_t>(at);
  if (face->property[wanted].is_list || !is_integer(face->property[wanted].type))
    throw_bad_file(path, "its face property '" + name + "' is no whole number per face", kCureLabels);
  Values values(path, header.format, file.substr(header.data_begin));
  std::vector<int> label;
  for (const PlyElement& element : header.element) {
    const bool is_face = &element == face;
    if (is_face) label.reserve(element.count);
    for (std::uint64_t item = 0; item < element.count && !element.property.empty(); ++item) {
      if (item % 4096 == 0) work.check();
      for (std::size_t p = 0; p < element.property.size(); ++p)
        if (is_face && p == wanted)
          label.push_back(checked(path, values.integer(element, item, element.property[p].type),
                                  "face " + std::to_string(item) + " (counted from 0)", item));
        else
          values.skip(element, item, element.property[p]);
    }
    if (is_face) break;
  }
  return label;
}

std::vector<int> read_seg(const Work& work, const std::filesystem::path& path, std::string_view file) {
  TextScanner scanner(file);
  std::vector<int> label;
  for (std::uint64_t line = 1; !scanner.at_end(); ++line) {
    if (line % 4096 == 0) work.check();
    TextScanner words(scanner.line());
    const std::string_view word = words.word();
    if (word.empty()) continue;
    const std::string where = "line " + std::to_string(line);
    std::int64_t value = 0;
    if (!parse_integer(word, value) || !words.word().empty())
      throw_bad_file(path, where + " ('" + printable(word) + "' ...) is no single whole number",
                     "give a .seg file: one label a line, in the order of the faces", line);
    label.push_back(checked(path, value, where, line));
  }
  return label;
}

}  // namespace

std::vector<int> read_face_labels(const Work& work, const std::filesystem::path& path, const std::string& property) {
  const FileBytes file(work, path);
  return read_face_labels(work, path, file.view(), property);
}

std::vector<int> read_face_labels(const Work& work, const std::filesystem::path& path, std::string_view bytes,
                                  const std::string& property) {
  if (const std::string kind = lower_extension(path); kind == ".off" || kind == ".obj" || kind == ".stl")
    throw_bad_file(path, "is a mesh of a kind that has no labels",
                   "give them as .seg, one a line in the order of the faces, or as an integer face property of a .ply");
  std::vector<int> label = is_ply(bytes) ? read_ply_labels(work, path, bytes, property) : read_seg(work, path, bytes);
  if (label.empty()) throw_bad_file(path, "has no labels", kCureLabels);
  return label;
}

bool has_face_property(const Work& work, const std::filesystem::path& path, const std::string& property) {
  const FileBytes file(work, path);
  if (!is_ply(file.view())) return false;
  const PlyHeader header = parse_ply_header(path, file.view());
  const PlyElement* face = header.find("face");
  const int at = face ? face->find(property) : -1;
  return at >= 0 && !face->property[static_cast<std::size_t>(at)].is_list &&
         is_integer(face->property[static_cast<std::size_t>(at)].type);
}

std::vector<int> labels_of_triangles(const std::filesystem::path& path, const std::vector<int>& label,
                                     const std::vector<Index>& source_face, Index triangles) {
  std::size_t wanted = triangles;
  if (!source_face.empty()) wanted = std::size_t{source_face.back()} + 1;
  // Faces of the file behind the last triangle may have had fewer than three corners.
  if (label.size() < wanted || (source_face.empty() && label.size() != wanted))
    throw_bad_file(
        path, "has " + std::to_string(label.size()) + " labels, but the mesh has " + std::to_string(wanted) + " faces",
        "give the labels of this very mesh, one per face in the order of its file");
  if (source_face.empty()) return label;
  std::vector<int> out(triangles);
  for (std::size_t t = 0; t < out.size(); ++t) out[t] = label[source_face[t]];
  return out;
}

Index number_labels(const std::vector<int>& label, std::vector<Index>& numbered) {
  std::vector<int> value(label);
  std::sort(value.begin(), value.end());
  value.erase(std::unique(value.begin(), value.end()), value.end());
  std::vector<Index> number(value.size(), kNone);
  numbered.resize(label.size());
  Index count = 0;
  for (std::size_t f = 0; f < label.size(); ++f) {
    Index& n = number[static_cast<std::size_t>(std::lower_bound(value.begin(), value.end(), label[f]) - value.begin())];
    if (n == kNone) n = count++;
    numbered[f] = n;
  }
  return count;
}

}  // namespace intarsia
