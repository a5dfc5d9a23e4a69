// Pieces to a PLY file, each at its own place.
#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include "engine/parallel/for_each.h"
#include "tools/make/shape.h"
#include "tools/make/temporary_file.h"

namespace intarsia::tools {

namespace {

static_assert(std::endian::native == std::endian::little, "the file is little-endian and written as memory lies");

template <class T>
void append(std::vector<char>& out, T value) {
  const std::size_t at = out.size();
  out.resize(at + sizeof value);
  std::memcpy(out.data() + at, &value, sizeof value);
}

}  // namespace

void make_to_file(const Work& work, const MakeOptions& options, const std::filesystem::path& path) {
  const auto source = plan_shape(work, options);
  const bool wide = options.double_coordinates;
  const std::string type = wide ? "double" : "float";
  const std::string header = "ply\nformat binary_little_endian 1.0\ncomment shape " + options.shape + " seed " +
                             std::to_string(options.seed) + "\nelement vertex " +
                             std::to_string(source->vertex_count()) + "\nproperty " + type + " x\nproperty " + type +
                             " y\nproperty " + type + " z\nelement face " + std::to_string(source->face_count()) +
                             "\nproperty list uchar int vertex_indices\nend_header\n";
  const std::uint64_t vertex_bytes = wide ? 24 : 12, face_bytes = 13;
  const std::uint64_t vertices_at = header.size(), faces_at = vertices_at + vertex_bytes * source->vertex_count();
  TemporaryFile file(path);
  file.write_at(0, header.data(), header.size());
  for_each(work, Cost::single, source->piece_count(), [&](std::size_t b) {
    Piece piece;
    source->make(work, b, piece);
    if (work.cancelled()) return;
    std::vector<char> bytes;
    bytes.reserve(std::max(vertex_bytes * piece.point.size(), face_bytes * piece.corner.size() / 3));
    for (const Vec3& p : piece.point)
      for (int a = 0; a < 3; ++a) {
        if (wide)
          append(bytes, p[a]);
        else
          append(bytes, static_cast<float>(p[a]));
      }
    file.write_at(vertices_at + vertex_bytes * source->first_vertex(b), bytes.data(), bytes.size());
    bytes.clear();
    for (std::size_t c = 0; c < piece.corner.size(); c += 3) {
      append(bytes, static_cast<std::uint8_t>(3));
      for (int i = 0; i < 3; ++i) append(bytes, static_cast<std::int32_t>(piece.corner[c + i]));
    }
    file.write_at(faces_at + face_bytes * source->first_face(b), bytes.data(), bytes.size());
  });
  file.finish();
}

}  // namespace intarsia::tools
