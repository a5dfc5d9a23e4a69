#include "engine/io/ply_header.h"

#include <algorithm>
#include <optional>

#include "engine/io/file_error.h"
#include "engine/io/text_scanner.h"

namespace intarsia {
namespace {

std::optional<PlyType> type_named(std::string_view word) {
  struct Name {
    std::string_view old_style, with_bits;
  };
  constexpr Name kNames[] = {{"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
                             {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
  for (std::size_t i = 0; i < std::size(kNames); ++i)
    if (word == kNames[i].old_style || word == kNames[i].with_bits) return static_cast<PlyType>(i);
  return std::nullopt;
}

class HeaderParser {
 public:
  HeaderParser(const std::filesystem::path& path, std::string_view file) : path_(path), file_(file) {}

  PlyHeader run() {
    if (file_.empty()) fail("the file is empty");
    if (next_line() != "ply") fail("does not begin with the word 'ply'");
    for (bool format_known = false;;) {
      const std::string_view line = next_line();
      TextScanner words(line);
      const std::string_view keyword = words.word();
      if (keyword == "end_header") {
        if (!format_known) fail("its header has no 'format' line");
        break;
      }
      if (keyword.empty() || keyword == "comment" || keyword == "obj_info") continue;
      if (keyword == "format") {
        read_format(words);
        format_known = true;
      } else if (keyword == "element") {
        read_element(words);
      } else if (keyword == "property") {
        read_property(words, line);
      } else {
        fail("unknown line '" + printable(line) + "' in its header");
      }
    }
    header_.data_begin = at_;
    check_counts();
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw_bad_file(path_, what, kCureExportAgain); }

  // The kind of line end is fixed by the first line: behind a lone \r a binary body may begin with the byte \n.
  std::string_view next_line() {
    const std::size_t end = file_.find_first_of("\r\n", at_);
    if (end == std::string_view::npos) fail("ends inside its header");
    if (line_end_.empty()) line_end_ = file_.substr(end, file_.substr(end, 2) == "\r\n" ? 2 : 1);
    const std::string_view line = file_.substr(at_, end - at_);
    at_ = end + (file_.substr(end, line_end_.size()) == line_end_ ? line_end_.size() : 1);
    return line;
  }

  void read_format(TextScanner& words) {
    const std::string_view name = words.word();
    if (name == "ascii") {
      header_.format = PlyFormat::ascii;
    } else if (name == "binary_little_endian") {
      header_.format = PlyFormat::little_endian;
    } else if (name == "binary_big_endian") {
      header_.format = PlyFormat::big_endian;
    } else {
      fail("unknown format '" + printable(name) + "' in its header");
    }
  }

  void read_element(TextScanner& words) {
    PlyElement element;
    element.name = words.word();
    std::int64_t count = 0;
    if (!parse_integer(words.word(), count) || count < 0)
      fail("its header gives no valid count for element '" + printable(element.name) + "'");
    if (header_.find(element.name)) fail("its header names element '" + printable(element.name) + "' twice");
    element.count = static_cast<std::uint64_t>(count);
    header_.element.push_back(std::move(element));
  }

  void read_property(TextScanner& words, std::string_view line) {
    if (header_.element.empty()) fail("its header has a property before the first element");
    PlyProperty property;
    std::string_view word = words.word();
    if (word == "list") {
      property.is_list = true;
      const auto count_type = type_named(words.word());
      if (!count_type || !is_integer(*count_type)) fail("bad list count type in '" + printable(line) + "'");
      property.count_type = *count_type;
      word = words.word();
    }
    const auto type = type_named(word);
    property.name = words.word();
    if (!type || property.name.empty()) fail("bad property line '" + printable(line) + "' in its header");
    property.type = *type;
    header_.element.back().property.push_back(std::move(property));
  }

  void check_counts() const {
    std::uint64_t left = file_.size() - at_;
    // An ascii file need not end with a line end.
    if (header_.format == PlyFormat::ascii) ++left;
    for (const PlyElement& e : header_.element) {
      const std::uint64_t least = e.least_bytes(header_.format);
      if (least != 0 && e.count > left / least)
        fail("its header promises " + std::to_string(e.count) + " of element '" + printable(e.name) + "', but only " +
             std::to_string(file_.size() - at_) + " bytes of data follow (cut file or wrong header)");
      left -= e.count * least;
    }
  }

  const std::filesystem::path& path_;
  std::string_view file_, line_end_;
  std::size_t at_ = 0;
  PlyHeader header_;
};

}  // namespace

int PlyElement::find(std::string_view property_name) const {
  const auto it =
      std::find_if(property.begin(), property.end(), [&](const PlyProperty& p) { return p.name == property_name; });
  return it == property.end() ? -1 : static_cast<int>(it - property.begin());
}

bool PlyElement::has_list() const {
  return std::any_of(property.begin(), property.end(), [](const PlyProperty& p) { return p.is_list; });
}

std::uint64_t PlyElement::least_bytes(PlyFormat format) const {
  std::uint64_t bytes = 0;
  for (const PlyProperty& p : property)
    bytes += format == PlyFormat::ascii ? 2 : size_of(p.is_list ? p.count_type : p.type);  // ascii: digit and blank
  return bytes;
}

const PlyElement* PlyHeader::find(std::string_view element_name) const {
  const auto it =
      std::find_if(element.begin(), element.end(), [&](const PlyElement& e) { return e.name == element_name; });
  return it == element.end() ? nullptr : &*it;
}

PlyHeader parse_ply_header(const std::filesystem::path& path, std::string_view file) {
  return HeaderParser(path, file).run();
}

}  // namespace intarsia
