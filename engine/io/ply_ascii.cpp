#include "engine/io/file_error.h"
#include "engine/io/ply_body.h"
#include "engine/io/text_scanner.h"

namespace intarsia {
namespace {

class AsciiReader {
 public:
  AsciiReader(const std::filesystem::path& path, std::string_view body) : path_(path), scanner_(body) {}

  void read_vertices(const Work& work, const PlyElement& element, const PlyTask& task, Soup& soup) {
    std::vector<Real>* target[3] = {&soup.x, &soup.y, &soup.z};
    for (auto* t : target) t->resize(element.count);
    for_items(work, element, [&](std::uint64_t item, std::size_t p, const PlyProperty& property) {
      bool wanted = false;
      for (int i = 0; i < 3; ++i)
        if (task.coordinate[i] == static_cast<int>(p)) {
          wanted = true;
          const Real value = read_real(element, item, property);
          check_coordinate(path_, item, value);
          (*target[i])[item] = value;
        }
      if (!wanted) skip(element, item, property);
    });
  }

  void read_faces(const Work& work, const PlyElement& element, const PlyTask& task, FaceCollector& faces) {
    std::vector<std::int64_t> corner;
    for_items(work, element, [&](std::uint64_t item, std::size_t p, const PlyProperty& property) {
      if (static_cast<int>(p) != task.list) return skip(element, item, property);
      corner.resize(read_count(element, item));
      for (auto& c : corner) c = read_integer(element, item);
      if (task.kind == PlyTask::Kind::polygons)
        faces.add_polygon(corner);
      else
        faces.add_strip(corner);
    });
  }

  void skip_items(const Work& work, const PlyElement& element) {
    for_items(work, element,
              [&](std::uint64_t item, std::size_t, const PlyProperty& property) { skip(element, item, property); });
  }

  void check_end() {
    const std::string_view word = scanner_.word();
    if (!word.empty())
      throw_bad_file(path_, "has more data ('" + printable(word) + "' ...) than its header announces",
                     "correct the counts in its header or export the mesh again");
  }

 private:
  template <class Body>
  void for_items(const Work& work, const PlyElement& element, const Body& body) {
    if (element.property.empty()) return;
    for (std::uint64_t item = 0; item < element.count; ++item) {
      if (item % 4096 == 0) work.check();
      for (std::size_t p = 0; p < element.property.size(); ++p) body(item, p, element.property[p]);
    }
  }

  std::string_view next(const PlyElement& element, std::uint64_t item) {
    const std::string_view word = scanner_.word();
    if (word.empty())
      throw_bad_file(path_,
                     "ends inside " + name_of_item(element, item) + " of " + std::to_string(element.count) +
                         " (cut file or wrong header)",
                     kCureExportAgain, item);
    return word;
  }

  Real read_real(const PlyElement& element, std::uint64_t item, const PlyProperty& property) {
    const std::string_view word = next(element, item);
    Real value = 0;
    bool good = false;
    if (property.type == PlyType::float32) {  // the same bits as in a binary copy of the file
      float narrow = 0;
      good = parse_real(word, narrow);
      value = narrow;
    } else {
      good = parse_real(word, value);
    }
    if (!good) bad_word(element, item, word);
    return value;
  }

  std::int64_t read_integer(const PlyElement& element, std::uint64_t item) {
    const std::string_view word = next(element, item);
    std::int64_t value = 0;
    if (!parse_integer(word, value)) bad_word(element, item, word);
    return value;
  }

  // A list needs two bytes for each of its items, so that no count can ask for more memory than the file explains.
  std::size_t read_count(const PlyElement& element, std::uint64_t item) {
    const std::int64_t count = read_integer(element, item);
    if (count < 0 || static_cast<std::uint64_t>(count) > scanner_.left() / 2)
      throw_bad_file(path_,
                     name_of_item(element, item) + " has a list of " + std::to_string(count) +
                         " items, for which the file has no room",
                     kCureExportAgain, item);
    return static_cast<std::size_t>(count);
  }

  void skip(const PlyElement& element, std::uint64_t item, const PlyProperty& property) {
    std::size_t words = property.is_list ? read_count(element, item) : 1;
    while (words-- > 0) next(element, item);
  }

  [[noreturn]] void bad_word(const PlyElement& element, std::uint64_t item, std::string_view word) const {
    throw_bad_file(path_, name_of_item(element, item) + " holds '" + printable(word) + "', which is not a number here",
                   "write numbers with a decimal point, as the header announces them, or export the mesh again", item);
  }

  static std::string name_of_item(const PlyElement& element, std::uint64_t item) {
    return printable(element.name) + " " + std::to_string(item) + " (counted from 0)";
  }

  const std::filesystem::path& path_;
  TextScanner scanner_;
};

}  // namespace

void read_ply_ascii(const Work& work, const std::filesystem::path& path, const PlyHeader& header,
                    const std::vector<PlyTask>& task, std::string_view body, Soup& soup, FaceCollector& faces) {
  AsciiReader reader(path, body);
  for (std::size_t e = 0; e < header.element.size(); ++e) {
    switch (task[e].kind) {
      case PlyTask::Kind::skip:
        reader.skip_items(work, header.element[e]);
        break;
      case PlyTask::Kind::vertices:
        reader.read_vertices(work, header.element[e], task[e], soup);
        break;
      case PlyTask::Kind::polygons:
      case PlyTask::Kind::strips:
        reader.read_faces(work, header.element[e], task[e], faces);
        break;
    }
  }
  reader.check_end();
}

}  // namespace intarsia
