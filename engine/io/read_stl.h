// Our STL reader, binary and ascii. OpenMesh 9's leaves out triangles with equal corners, which shifts the numbers of
// all later faces, and does not notice the end of the file.
#pragma once

#include <filesystem>
#include <string_view>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia {

// Triangles in file order, exactly equal corners welded (-0 equals 0), vertices in the order of first appearance.
// `path` is only named in errors. Errors: bad_file (element = triangle of the file), too_large.
Soup read_stl(const Work& work, const std::filesystem::path& path, std::string_view file);

}  // namespace intarsia
