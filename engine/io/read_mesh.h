// Reads a triangle surface from a file: PLY, OBJ, STL, OFF.
#pragma once

#include <filesystem>
#include <string_view>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia {

// The kind of file is told by its first bytes or else by its extension (.ply .obj .stl .off, in any case of letters).
// Vertices and faces keep the order of the file; polygons become fans of triangles around their first corner, and
// source_face then tells the face of the file (counted from 0). Nothing is cleaned: faces may repeat corners, vertices
// may be unused. The corners of STL triangles are welded where they are exactly equal (-0 equals 0).
// Ensures: at least one face; every corner below vertex_count; every coordinate finite (and below 1e100).
// Errors: bad_file naming the file, the element (in the numbering of the file, from 0) and a cure; too_large;
// no_memory.
Soup read_mesh(const Work& work, const std::filesystem::path& path);
// The same of bytes in memory; path: what they are called.
Soup read_mesh(const Work& work, const std::filesystem::path& path, std::string_view bytes);

}  // namespace intarsia
