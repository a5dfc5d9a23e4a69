#include "engine/io/read_mesh.h"

#include <new>

#include "engine/io/file_bytes.h"
#include "engine/io/file_error.h"
#include "engine/io/read_ply.h"

namespace intarsia {

Soup read_mesh(const Work& work, const std::filesystem::path& path) {
  try {
    const FileBytes file(work, path);
    if (file.view().empty()) throw_bad_file(path, "is empty", kCureExportAgain);
    Soup soup = read_ply(work, path, file.view());
    if (soup.corner.empty())
      throw_bad_file(path, "has " + std::to_string(soup.vertex_count()) + " vertices but no faces",
                     "give a surface of triangles or polygons, not a point cloud");
    return soup;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::no_memory,
                path.string() + ": does not fit in memory; simplify the mesh or use a larger machine");
  }
}

}  // namespace intarsia
