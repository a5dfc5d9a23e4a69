// OBJ and OFF text made plain for OpenMesh's readers, which skip lines that they do not understand (so that all later
// corners name wrong vertices), open material files, stumble over comments, round coordinates to float, and believe
// every count. Here each vertex and face is checked; what remains for them to read is a file without surprises.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/types.h"
#include "engine/parallel/work.h"

namespace intarsia {

struct PlainText {
  // A face that OpenMesh would leave out or change: fewer than three corners, or corners that repeat.
  struct OddFace {
    std::uint64_t face;
    std::size_t begin, end;  // of its corners in odd_corner
  };

  std::string text;                      // vertices and all other faces, one a line
  std::vector<Real> x, y, z;             // of all vertices, in the precision of the file
  std::vector<OddFace> odd_face;         // ascending
  std::vector<std::int64_t> odd_corner;  // vertices counted from 0, not checked
  std::uint64_t face_count = 0;          // all faces of the file
};

// Errors: bad_file naming the line (counted from 1) and the vertex or face; too_large.
PlainText plain_obj(const Work& work, const std::filesystem::path& path, std::string_view file);
PlainText plain_off(const Work& work, const std::filesystem::path& path, std::string_view file);

}  // namespace intarsia
