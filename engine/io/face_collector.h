// Turns the faces of a file, one after the other, into the triangles of a Soup, checking every corner.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/data/mesh.h"

namespace intarsia {

class FaceCollector {
 public:
  // `vertex_count`: corners must be below it. Triangles go behind those that `soup` has.
  FaceCollector(const std::filesystem::path& path, std::uint64_t vertex_count, Soup& soup)
      : path_(path), vertex_count_(vertex_count), soup_(soup) {}

  // Adds one face of the file as a fan of triangles around its first corner. A face of fewer than three corners has no
  // area: it becomes no triangle, but counts in the numbering. Corners that repeat are kept as they are.
  // Errors: bad_file (element = face of the file); too_large.
  void add_polygon(std::span<const std::int64_t> vertex);

  // Adds the triangles of strips: corner i joins the two before it, every second triangle turned over, -1 begins a new
  // strip. Triangles with a repeated corner only steer the strip and are left out. Each other one counts as a face.
  void add_strip(std::span<const std::int64_t> vertex);

  // Adds `count` faces whose triangles, `triangles_per_face` each, the caller has appended to soup.corner, checked.
  void count_uniform(std::uint64_t count, std::uint64_t triangles_per_face);

  std::uint64_t face_count() const { return faces_; }

  [[noreturn]] void throw_bad_corner(std::uint64_t face, std::int64_t vertex) const;
  // Errors: too_large if the soup would have more triangles than an Index can number.
  void check_room(std::uint64_t more_triangles) const;

 private:
  void check(std::uint64_t face, std::int64_t vertex) const {
    if (static_cast<std::uint64_t>(vertex) >= vertex_count_) throw_bad_corner(face, vertex);
  }
  void push(std::int64_t a, std::int64_t b, std::int64_t c);
  void separate_numbers();

  const std::filesystem::path& path_;
  std::uint64_t vertex_count_;
  Soup& soup_;
  std::uint64_t faces_ = 0;
  bool separate_ = false;  // triangles and faces are numbered apart: source_face is kept
};

// Errors: bad_file if a coordinate is no usable number (element = vertex); too_large.
void check_coordinate(const std::filesystem::path& path, std::uint64_t vertex, Real value);
void check_vertex_count(const std::filesystem::path& path, std::uint64_t count);

// Squares, and products of a few of them, must stay finite.
inline constexpr Real kLargestCoordinate = 1e100;
inline bool is_usable(Real value) { return value >= -kLargestCoordinate && value <= kLargestCoordinate; }

}  // namespace intarsia
