#include "tools/read_deviation.h"

#include <cmath>
#include <cstring>

#include "engine/base/error.h"
#include "engine/io/file_bytes.h"
#include "engine/io/ply_header.h"

namespace intarsia::tools {

std::vector<Real> read_face_deviation(const Work& work, const std::filesystem::path& path) {
  if (!std::filesystem::exists(path))
    throw Error(ErrorCode::bad_file, path.string() + ": there is no such file; intarsia eval DIR writes it");
  const auto foreign = [&]() -> Error {
    return {ErrorCode::bad_file, path.string() + ": it is not as intarsia eval writes it; let it write it again"};
  };
  const FileBytes bytes(work, path);
  const std::string_view file = bytes.view();
  const PlyHeader header = parse_ply_header(path, file);
  const PlyElement *vertex = header.find("vertex"), *face = header.find("face");
  if (header.format != PlyFormat::little_endian || header.element.size() != 2 || !vertex || !face ||
      vertex != &header.element[0] || vertex->has_list() || face->property.empty() || !face->property[0].is_list)
    throw foreign();
  // A triangle's list, then scalars: all faces take as many bytes.
  const int wanted = face->find("distance_rms");
  const std::size_t count_size = size_of(face->property[0].count_type);
  std::size_t size = count_size + 3 * size_of(face->property[0].type), place = 0;
  for (std::size_t i = 1; i < face->property.size(); ++i) {
    if (face->property[i].is_list) throw foreign();
    if (static_cast<int>(i) == wanted) place = size;
    size += size_of(face->property[i].type);
  }
  if (wanted < 1 || face->property[wanted].type != PlyType::float32 || count_size != 1) throw foreign();
  std::size_t at = header.data_begin + vertex->count * vertex->least_bytes(header.format);
  if (at > file.size() || face->count > (file.size() - at) / size) throw foreign();
  std::vector<Real> deviation(face->count);
  for (Real& d : deviation) {
    float value = 0;
    std::memcpy(&value, file.data() + at + place, sizeof value);
    if (file[at] != 3 || !std::isfinite(value)) throw foreign();
    d = value, at += size;
  }
  return deviation;
}

}  // namespace intarsia::tools
