// The data part of a PLY file, element by element. Parts of read_ply.
#pragma once

#include <filesystem>
#include <string_view>

#include "engine/io/face_collector.h"
#include "engine/io/ply_header.h"
#include "engine/parallel/work.h"

namespace intarsia {

// What to do with one element of the header.
struct PlyTask {
  enum class Kind : std::uint8_t { skip, vertices, polygons, strips };
  Kind kind = Kind::skip;
  int coordinate[3] = {-1, -1, -1};  // vertices: positions of the properties x, y, z
  int list = -1;                     // polygons, strips: position of the index list
};

// Both read every element in order, into `soup` and `faces`; `task` has one entry for each element of the header.
void read_ply_ascii(const Work& work, const std::filesystem::path& path, const PlyHeader& header,
                    const std::vector<PlyTask>& task, std::string_view body, Soup& soup, FaceCollector& faces);
// The same as read_ply_ascii, on all threads, for the usual files. False, and nothing done, for all others.
bool read_ply_lines(const Work& work, const PlyHeader& header, const std::vector<PlyTask>& task, std::string_view body,
                    Soup& soup, FaceCollector& faces);
void read_ply_binary(const Work& work, const std::filesystem::path& path, const PlyHeader& header,
                     const std::vector<PlyTask>& task, std::string_view body, Soup& soup, FaceCollector& faces);

}  // namespace intarsia
