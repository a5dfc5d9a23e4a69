// The usual form of an ascii body, read on all threads: one item a line, plain vertices, then triangles. Whatever is
// not exactly that is left to the reader of words, which also finds the words for what is wrong.
#include <algorithm>
#include <atomic>
#include <cstring>

#include "engine/io/ply_body.h"
#include "engine/io/text_scanner.h"
#include "engine/parallel/for_each.h"

namespace intarsia {
namespace {

struct Form {
  const PlyElement* vertex = nullptr;
  const PlyElement* face = nullptr;
  PlyTask vertex_task, face_task;
};

bool find_form(const PlyHeader& header, const std::vector<PlyTask>& task, Form& form) {
  for (std::size_t e = 0; e < header.element.size(); ++e) {
    const PlyElement& element = header.element[e];
    if (element.count == 0) continue;
    if (task[e].kind == PlyTask::Kind::vertices && !form.vertex && !element.has_list()) {
      form.vertex = &element, form.vertex_task = task[e];
    } else if (task[e].kind == PlyTask::Kind::polygons && form.vertex && !form.face) {
      form.face = &element, form.face_task = task[e];
    } else {
      return false;
    }
  }
  if (!form.vertex || !form.face) return false;
  const auto lists = std::count_if(form.face->property.begin(), form.face->property.end(),
                                   [](const PlyProperty& p) { return p.is_list; });
  return lists == 1;
}

bool read_vertex(const Form& form, TextScanner words, std::uint64_t v, Soup& soup) {
  std::vector<Real>* const target[3] = {&soup.x, &soup.y, &soup.z};
  for (std::size_t p = 0; p < form.vertex->property.size(); ++p) {
    const std::string_view word = words.word();
    if (word.empty()) return false;
    for (int i = 0; i < 3; ++i) {
      if (form.vertex_task.coordinate[i] != static_cast<int>(p)) continue;
      Real value = 0;
      if (form.vertex->property[p].type == PlyType::float32) {  // the same bits as in a binary copy of the file
        float narrow = 0;
        if (!parse_real(word, narrow)) return false;
        value = narrow;
      } else if (!parse_real(word, value)) {
        return false;
      }
      if (!is_usable(value)) return false;
      (*target[i])[v] = value;
    }
  }
  return words.word().empty();
}

bool read_triangle(const Form& form, TextScanner words, std::uint64_t f, Soup& soup) {
  for (std::size_t p = 0; p < form.face->property.size(); ++p) {
    std::string_view word = words.word();
    if (word.empty()) return false;
    if (static_cast<int>(p) != form.face_task.list) continue;
    if (word != "3") return false;
    for (std::size_t i = 0; i < 3; ++i) {
      std::int64_t corner = 0;
      if (!parse_integer(words.word(), corner) || static_cast<std::uint64_t>(corner) >= form.vertex->count)
        return false;
      soup.corner[3 * f + i] = static_cast<Index>(corner);
    }
  }
  return words.word().empty();
}

}  // namespace

bool read_ply_lines(const Work& work, const PlyHeader& header, const std::vector<PlyTask>& task, std::string_view body,
                    Soup& soup, FaceCollector& faces) {
  Form form;
  if (!find_form(header, task, form)) return false;
  const std::uint64_t vertices = form.vertex->count, triangles = form.face->count;
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  const std::size_t pieces = (body.size() + kPiece - 1) / kPiece;
  std::vector<std::uint64_t> first(pieces + 1, 0);  // line that each piece begins in
  for_each(work, Cost::single, pieces, [&](std::size_t p) {
    const std::string_view piece = body.substr(p * kPiece, kPiece);
    first[p + 1] = static_cast<std::uint64_t>(std::count(piece.begin(), piece.end(), '\n'));
  });
  for (std::size_t p = 0; p < pieces; ++p) first[p + 1] += first[p];
  const bool has_open_line = !body.empty() && body.back() != '\n';
  if (first[pieces] + (has_open_line ? 1 : 0) < vertices + triangles) return false;

  faces.check_room(triangles);
  for (auto* a : {&soup.x, &soup.y, &soup.z}) a->resize(vertices);
  soup.corner.resize(3 * triangles);
  std::atomic<bool> odd{false};
  for_each(work, Cost::single, pieces, [&](std::size_t p) {
    // Lines that begin in this piece, which the one before it may cut.
    std::size_t at = p * kPiece;
    std::uint64_t line = first[p];
    if (p > 0 && body[at - 1] != '\n') {
      at = body.find('\n', at);
      if (at == std::string_view::npos) return;
      ++at, ++line;
    }
    for (; at < std::min(body.size(), (p + 1) * kPiece) && !odd.load(std::memory_order_relaxed); ++line) {
      const void* found = std::memchr(body.data() + at, '\n', body.size() - at);
      const std::size_t end =
          found ? static_cast<std::size_t>(static_cast<const char*>(found) - body.data()) : body.size();
      const TextScanner words(body.substr(at, end - at));
      const bool good = line < vertices               ? read_vertex(form, words, line, soup)
                        : line < vertices + triangles ? read_triangle(form, words, line - vertices, soup)
                                                      : TextScanner(words).word().empty();
      if (!good) odd = true;
      at = end + 1;
    }
  });
  if (odd) {
    soup = {};
    return false;
  }
  faces.count_uniform(triangles, 1);
  return true;
}

}  // namespace intarsia
