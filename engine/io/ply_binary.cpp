#include <bit>
#include <cstring>

#include "engine/io/file_error.h"
#include "engine/io/ply_body.h"
#include "engine/parallel/reduce.h"

namespace intarsia {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class T, bool kSwap>
T load(const char* from) {
  char bytes[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes[i] = from[kSwap ? sizeof(T) - 1 - i : i];
  return std::bit_cast<T>(bytes);
}

// Calls f with a value of the C++ type that a PLY type means.
template <class F>
auto with_type(PlyType type, const F& f) {
  switch (type) {
    case PlyType::int8:
      return f(std::int8_t{});
    case PlyType::uint8:
      return f(std::uint8_t{});
    case PlyType::int16:
      return f(std::int16_t{});
    case PlyType::uint16:
      return f(std::uint16_t{});
    case PlyType::int32:
      return f(std::int32_t{});
    case PlyType::uint32:
      return f(std::uint32_t{});
    case PlyType::float32:
      return f(float{});
    case PlyType::float64:
      break;
  }
  return f(double{});
}

template <bool kSwap>
std::int64_t load_integer(PlyType type, const char* from) {
  return with_type(type, [&](auto t) { return static_cast<std::int64_t>(load<decltype(t), kSwap>(from)); });
}

constexpr std::uint64_t kAllGood = ~std::uint64_t{0};

// decode(begin, end) -> first bad item of the block or kAllGood; returns the first bad item of all.
template <class Decode>
std::uint64_t first_bad(const Work& work, std::uint64_t count, const Decode& decode) {
  return reduce(work, Cost::light, count, kAllGood, decode,
                [](std::uint64_t a, std::uint64_t b) { return std::min(a, b); });
}

template <bool kSwap>
class BinaryReader {
 public:
  BinaryReader(const std::filesystem::path& path, std::string_view body)
      : path_(path), at_(body.data()), end_(body.data() + body.size()) {}

  void read_vertices(const Work& work, const PlyElement& element, const PlyTask& task, Soup& soup) {
    std::vector<Real>* target[3] = {&soup.x, &soup.y, &soup.z};
    for (auto* t : target) t->resize(element.count);
    if (element.has_list()) return walk_vertices(work, element, task, target);
    const std::size_t stride = element.least_bytes(PlyFormat::little_endian);
    const char* data = take_items(element, element.count, stride);
    std::uint64_t bad[3];
    for (int i = 0; i < 3; ++i) {
      const auto p = static_cast<std::size_t>(task.coordinate[i]);
      const char* from = data + offset_of(element, p);
      Real* to = target[i]->data();
      bad[i] = with_type(element.property[p].type, [&](auto t) {
        return first_bad(work, element.count, [&](std::size_t begin, std::size_t end) {
          bool good = true;
          for (std::size_t v = begin; v < end; ++v) {
            to[v] = static_cast<Real>(load<decltype(t), kSwap>(from + v * stride));
            good &= is_usable(to[v]);
          }
          for (std::size_t v = begin; !good && v < end; ++v)
            if (!is_usable(to[v])) return std::uint64_t{v};
          return kAllGood;
        });
      });
    }
    const std::uint64_t v = std::min({bad[0], bad[1], bad[2]});
    for (int i = 0; i < 3 && v != kAllGood; ++i) check_coordinate(path_, v, (*target[i])[v]);
  }

  void read_faces(const Work& work, const PlyElement& element, const PlyTask& task, Soup& soup,
                  std::uint64_t vertex_count, FaceCollector& faces) {
    if (task.kind == PlyTask::Kind::polygons && read_uniform(work, element, task, soup, vertex_count, faces)) return;
    std::vector<std::int64_t> corner;
    walk(work, element, [&](std::uint64_t item, std::size_t p, const PlyProperty& property) {
      if (static_cast<int>(p) != task.list) return skip(element, item, property);
      corner.resize(take_count(element, item, property));
      const char* from = take(element, item, corner.size() * size_of(property.type));
      with_type(property.type, [&](auto t) {
        for (std::size_t i = 0; i < corner.size(); ++i)
          // An int8 is a number here, no character. NOLINTNEXTLINE(bugprone-signed-char-misuse)
          corner[i] = static_cast<std::int64_t>(load<decltype(t), kSwap>(from + i * sizeof t));
      });
      if (task.kind == PlyTask::Kind::polygons)
        faces.add_polygon(corner);
      else
        faces.add_strip(corner);
    });
  }

  void skip_items(const Work& work, const PlyElement& element) {
    if (!element.has_list()) {
      take_items(element, element.count, element.least_bytes(PlyFormat::little_endian));
      return;
    }
    walk(work, element,
         [&](std::uint64_t item, std::size_t, const PlyProperty& property) { skip(element, item, property); });
  }

  // Writers may end a file with a line end or pad it with zeros; anything else means that the header is wrong.
  void check_end() const {
    for (const char* c = at_; c != end_; ++c)
      if (*c != 0 && *c != '\n' && *c != '\r' && *c != ' ')
        throw_bad_file(path_, std::to_string(end_ - at_) + " bytes follow the data that its header announces",
                       "correct its header or export the mesh again");
  }

 private:
  // Faces that all have as many corners as the first one lie at equal steps. That holds if every count read at these
  // steps is the same (by induction from the first); otherwise the result is discarded and the list walked.
  bool read_uniform(const Work& work, const PlyElement& element, const PlyTask& task, Soup& soup,
                    std::uint64_t vertex_count, FaceCollector& faces) {
    const auto list = static_cast<std::size_t>(task.list);
    for (std::size_t p = 0; p < element.property.size(); ++p)
      if (p != list && element.property[p].is_list) return false;
    const PlyProperty& property = element.property[list];
    const std::size_t least = element.least_bytes(PlyFormat::little_endian), before = offset_of(element, list);
    if (element.count == 0 || left() < least) return false;
    const std::int64_t corners = load_integer<kSwap>(property.count_type, at_ + before);
    if (corners < 3 || corners > 255) return false;
    const auto n = static_cast<std::size_t>(corners);
    const std::size_t stride = least + n * size_of(property.type), triangles = n - 2;
    if (left() / stride < element.count) return false;

    faces.check_room(element.count * triangles);
    const std::size_t corner_begin = soup.corner.size();
    soup.corner.resize(corner_begin + 3 * triangles * element.count);
    Index* to = soup.corner.data() + corner_begin;
    const char* count_at = at_ + before;
    const char* corner_at = count_at + size_of(property.count_type);
    constexpr std::uint64_t kNotUniform = 0;  // a bad face f is reported as f + 1
    const std::uint64_t bad = with_type(property.type, [&](auto t) {
      using T = decltype(t);
      return first_bad(work, element.count, [&](std::size_t begin, std::size_t end) {
        std::uint64_t bad_face = kAllGood;
        for (std::size_t f = begin; f < end; ++f) {
          if (load_integer<kSwap>(property.count_type, count_at + f * stride) != corners) return kNotUniform;
          const char* from = corner_at + f * stride;
          const auto corner = [&](std::size_t i) {
            return static_cast<std::int64_t>(load<T, kSwap>(from + i * sizeof(T)));
          };
          bool good = true;
          for (std::size_t i = 0; i < n; ++i) good &= static_cast<std::uint64_t>(corner(i)) < vertex_count;
          if (!good) bad_face = std::min(bad_face, std::uint64_t{f} + 1);
          Index* face = to + f * 3 * triangles;
          for (std::size_t i = 0; i < triangles; ++i, face += 3) {
            face[0] = static_cast<Index>(corner(0));
            face[1] = static_cast<Index>(corner(i + 1));
            face[2] = static_cast<Index>(corner(i + 2));
          }
        }
        return bad_face;
      });
    });
    if (bad == kNotUniform) {
      soup.corner.resize(corner_begin);
      return false;
    }
    for (std::size_t i = 0; bad != kAllGood && i < n; ++i) {
      const std::int64_t v =
          load_integer<kSwap>(property.type, corner_at + (bad - 1) * stride + i * size_of(property.type));
      if (static_cast<std::uint64_t>(v) >= vertex_count) faces.throw_bad_corner(faces.face_count() + bad - 1, v);
    }
    faces.count_uniform(element.count, triangles);
    at_ += element.count * stride;
    return true;
  }

  void walk_vertices(const Work& work, const PlyElement& element, const PlyTask& task,
                     std::vector<Real>* const target[3]) {
    walk(work, element, [&](std::uint64_t item, std::size_t p, const PlyProperty& property) {
      if (property.is_list) return skip(element, item, property);
      const char* from = take(element, item, size_of(property.type));
      for (int i = 0; i < 3; ++i)
        if (task.coordinate[i] == static_cast<int>(p)) {
          const Real value =
              with_type(property.type, [&](auto t) { return static_cast<Real>(load<decltype(t), kSwap>(from)); });
          check_coordinate(path_, item, value);
          (*target[i])[item] = value;
        }
    });
  }

  template <class Body>
  void walk(const Work& work, const PlyElement& element, const Body& body) {
    for (std::uint64_t item = 0; item < element.count; ++item) {
      if (item % 4096 == 0) work.check();
      for (std::size_t p = 0; p < element.property.size(); ++p) body(item, p, element.property[p]);
    }
  }

  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  const char* take(const PlyElement& element, std::uint64_t item, std::size_t bytes) {
    if (bytes > left())
      throw_bad_file(path_,
                     "ends inside " + printable(element.name) + " " + std::to_string(item) + " (counted from 0) of " +
                         std::to_string(element.count) + " (cut file or wrong header)",
                     kCureExportAgain, item);
    const char* from = at_;
    at_ += bytes;
    return from;
  }

  // `count` items of equal size.
  const char* take_items(const PlyElement& element, std::uint64_t count, std::size_t stride) {
    if (stride == 0) return at_;
    if (left() / stride < count) take(element, left() / stride, left() + 1);
    const char* from = at_;
    at_ += count * stride;
    return from;
  }

  std::size_t take_count(const PlyElement& element, std::uint64_t item, const PlyProperty& property) {
    const std::int64_t count =
        load_integer<kSwap>(property.count_type, take(element, item, size_of(property.count_type)));
    if (count < 0 || static_cast<std::uint64_t>(count) > left() / size_of(property.type))
      throw_bad_file(path_,
                     printable(element.name) + " " + std::to_string(item) + " (counted from 0) has a list of " +
                         std::to_string(count) + " items, for which the file has no room",
                     kCureExportAgain, item);
    return static_cast<std::size_t>(count);
  }

  void skip(const PlyElement& element, std::uint64_t item, const PlyProperty& property) {
    if (property.is_list)
      take(element, item, take_count(element, item, property) * size_of(property.type));
    else
      take(element, item, size_of(property.type));
  }

  // Bytes of an item before property p; properties before it are scalars.
  static std::size_t offset_of(const PlyElement& element, std::size_t p) {
    std::size_t offset = 0;
    for (std::size_t i = 0; i < p; ++i) offset += size_of(element.property[i].type);
    return offset;
  }

  const std::filesystem::path& path_;
  const char* at_;
  const char* end_;
};

template <bool kSwap>
void read_binary(const Work& work, const std::filesystem::path& path, const PlyHeader& header,
                 const std::vector<PlyTask>& task, std::string_view body, Soup& soup, FaceCollector& faces) {
  const std::uint64_t vertex_count = header.find("vertex")->count;
  BinaryReader<kSwap> reader(path, body);
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
        reader.read_faces(work, header.element[e], task[e], soup, vertex_count, faces);
        break;
    }
  }
  reader.check_end();
}

}  // namespace

void read_ply_binary(const Work& work, const std::filesystem::path& path, const PlyHeader& header,
                     const std::vector<PlyTask>& task, std::string_view body, Soup& soup, FaceCollector& faces) {
  if (header.format == PlyFormat::big_endian)
    read_binary<true>(work, path, header, task, body, soup, faces);
  else
    read_binary<false>(work, path, header, task, body, soup, faces);
}

}  // namespace intarsia
