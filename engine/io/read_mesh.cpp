#include "engine/io/read_mesh.h"

#include <new>
#include <string>

#include "engine/io/extension.h"
#include "engine/io/file_bytes.h"
#include "engine/io/file_error.h"
#include "engine/io/plain_text.h"
#include "engine/io/read_ply.h"
#include "engine/io/read_stl.h"
#include "engine/io/read_with_openmesh.h"
#include "engine/io/text_scanner.h"

namespace intarsia {
namespace {

enum class Format { ply, obj, stl, off };

Format format_of(const std::filesystem::path& path, std::string_view file) {
  TextScanner scanner(file.substr(0, 64));
  const std::string_view word = scanner.word();
  if (word == "ply") return Format::ply;
  if (word == "OFF" || word == "COFF" || word == "NOFF" || word == "CNOFF" || word.substr(0, 5) == "STOFF")
    return Format::off;
  const std::string extension = lower_extension(path);
  if (extension == ".ply") return Format::ply;
  if (extension == ".obj") return Format::obj;
  if (extension == ".stl") return Format::stl;
  if (extension == ".off") return Format::off;
  throw_bad_file(path, "is no file of a kind that can be read", "give a .ply, .obj, .stl or .off file");
}

Soup read(const Work& work, const std::filesystem::path& path, std::string_view file) {
  switch (format_of(path, file)) {
    case Format::ply:
      break;
    case Format::obj:
      return read_with_openmesh(work, path, plain_obj(work, path, file), "obj");
    case Format::stl:
      return read_stl(work, path, file);
    case Format::off:
      return read_with_openmesh(work, path, plain_off(work, path, file), "off");
  }
  return read_ply(work, path, file);
}

}  // namespace

Soup read_mesh(const Work& work, const std::filesystem::path& path) {
  const FileBytes file(work, path);
  return read_mesh(work, path, file.view());
}

Soup read_mesh(const Work& work, const std::filesystem::path& path, std::string_view bytes) {
  try {
    if (bytes.empty()) throw_bad_file(path, "is empty", kCureExportAgain);
    Soup soup = read(work, path, bytes);
    if (soup.corner.empty())
      throw_bad_file(path, "has " + std::to_string(soup.vertex_count()) + " vertices but no triangles or polygons",
                     "give a surface, not a point cloud or curves");
    return soup;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::no_memory,
                path.string() + ": does not fit in memory; simplify the mesh or use a larger machine");
  }
}

}  // namespace intarsia
