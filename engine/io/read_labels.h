// Integer labels of faces: from a PLY file's face property, or from a .seg file (Chen, Golovinskiy, Funkhouser 2009).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/types.h"
#include "engine/parallel/work.h"

namespace intarsia {

// One integer per face of the file, in its order. PLY files (told by their first bytes): the integer property of that
// name of the element face, in any scalar type that holds integers. Everything else: text with one integer a line, as
// .seg files have it (`property` is not used).
// Ensures: at least one label. Labels may be negative or have gaps.
// Errors: bad_file naming the file and the line or face; too_large.
std::vector<int> read_face_labels(const Work& work, const std::filesystem::path& path, const std::string& property);

// The same of bytes in memory; path: what they are called.
std::vector<int> read_face_labels(const Work& work, const std::filesystem::path& path, std::string_view bytes,
                                  const std::string& property);

// True if the file is a PLY file whose faces have that integer property.
bool has_face_property(const Work& work, const std::filesystem::path& path, const std::string& property);

// Labels of the triangles of a mesh that was read from a file with polygons.
// source_face: as Soup::source_face (empty: one label per triangle already).
// Errors: bad_file if there are more or fewer labels than faces.
std::vector<int> labels_of_triangles(const std::filesystem::path& path, const std::vector<int>& label,
                                     const std::vector<Index>& source_face, Index triangles);

// The same partition with labels 0 .. count - 1 in the order of their first face; returns count.
Index number_labels(const std::vector<int>& label, std::vector<Index>& numbered);

}  // namespace intarsia
