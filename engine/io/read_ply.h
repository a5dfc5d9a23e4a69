// Our PLY reader: ascii and binary of both byte orders, every scalar type, polygons, triangle strips.
#pragma once

#include <filesystem>
#include <string_view>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia {

// Reads elements vertex (x y z), face (vertex_indices or vertex_index) and tristrips (the same lists, -1 restarts);
// skips everything else. Coordinates keep the precision that the header declares.
// Ensures: every corner names a vertex, every coordinate is finite; memory is bounded by the size of the file.
// `path` is only named in errors. Errors: bad_file (element = vertex or face of the file), too_large.
Soup read_ply(const Work& work, const std::filesystem::path& path, std::string_view file);

}  // namespace intarsia
