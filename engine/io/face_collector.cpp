#include "engine/io/face_collector.h"

#include <array>
#include <cstdio>
#include <numeric>

#include "engine/io/file_error.h"

namespace intarsia {

void FaceCollector::add_polygon(std::span<const std::int64_t> vertex) {
  for (const std::int64_t v : vertex) check(faces_, v);
  if (vertex.size() != 3) separate_numbers();
  if (vertex.size() >= 3) check_room(vertex.size() - 2);
  for (std::size_t i = 2; i < vertex.size(); ++i) push(vertex[0], vertex[i - 1], vertex[i]);
  ++faces_;
}

void FaceCollector::add_strip(std::span<const std::int64_t> vertex) {
  std::size_t begin = 0;  // of the current strip
  for (std::size_t i = 0; i < vertex.size(); ++i) {
    if (vertex[i] == -1) {
      begin = i + 1;
      continue;
    }
    check(faces_, vertex[i]);
    if (i < begin + 2) continue;
    const std::int64_t a = vertex[i - 2], b = vertex[i - 1], c = vertex[i];
    if (a == b || b == c || c == a) continue;
    check_room(1);
    if ((i - begin) % 2 == 0)
      push(a, b, c);
    else
      push(b, a, c);
    ++faces_;
  }
}

void FaceCollector::count_uniform(std::uint64_t count, std::uint64_t triangles_per_face) {
  if (triangles_per_face != 1) separate_numbers();
  if (separate_)
    for (std::uint64_t f = 0; f < count; ++f)
      soup_.source_face.insert(soup_.source_face.end(), triangles_per_face, static_cast<Index>(faces_ + f));
  faces_ += count;
}

void FaceCollector::push(std::int64_t a, std::int64_t b, std::int64_t c) {
  if (separate_) soup_.source_face.push_back(static_cast<Index>(faces_));
  for (const std::int64_t v : {a, b, c}) soup_.corner.push_back(static_cast<Index>(v));
}

// Until now every face was one triangle.
void FaceCollector::separate_numbers() {
  if (separate_) return;
  soup_.source_face.resize(faces_);
  std::iota(soup_.source_face.begin(), soup_.source_face.end(), Index{0});
  separate_ = true;
}

void FaceCollector::throw_bad_corner(std::uint64_t face, std::int64_t vertex) const {
  throw_bad_file(path_,
                 "face " + std::to_string(face) + " (counted from 0) names vertex " + std::to_string(vertex) +
                     ", but the file has vertices 0 to " + std::to_string(vertex_count_ - 1),
                 "remove that face or export the mesh again", face);
}

void FaceCollector::check_room(std::uint64_t more_triangles) const {
  constexpr std::uint64_t kMost = (kNone - 1) / 3;  // corners are numbered by Index, too
  if (soup_.corner.size() / 3 + more_triangles > kMost)
    throw Error(ErrorCode::too_large, path_.string() + ": has more than " + std::to_string(kMost) +
                                          " triangles; simplify the mesh or cut it into pieces");
}

void check_coordinate(const std::filesystem::path& path, std::uint64_t vertex, Real value) {
  if (is_usable(value)) return;
  std::array<char, 32> shown{};
  std::snprintf(shown.data(), shown.size(), "%g", value);
  throw_bad_file(path,
                 "vertex " + std::to_string(vertex) + " (counted from 0) has the coordinate " + shown.data() +
                     ", which is not a usable number",
                 "remove that vertex and its faces or export the mesh again", vertex);
}

void check_vertex_count(const std::filesystem::path& path, std::uint64_t count) {
  if (count >= kNone)
    throw Error(ErrorCode::too_large, path.string() + ": has " + std::to_string(count) + " vertices, the limit is " +
                                          std::to_string(kNone - 1) + "; simplify the mesh or cut it into pieces");
}

}  // namespace intarsia
