// Curves that users give: polylines from files.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "engine/base/types.h"
#include "engine/parallel/work.h"

namespace intarsia {

// .obj: vertices `v x y z` and lines `l i j k ...` (from 1, or from the end where negative; what follows a `/` is left
// out); everything else is passed over. .txt (as CGAL's .polylines.txt has it): on each line a number n of points, then
// 3 n coordinates. Told apart by the name's ending.
// Ensures: every polyline has at least two points, all finite; at least one polyline.
// Errors: bad_file naming the file and the line.
std::vector<std::vector<Vec3>> read_polylines(const Work& work, const std::filesystem::path& path);

// The same of text in memory; path: what it is called.
std::vector<std::vector<Vec3>> read_polylines(const Work& work, const std::filesystem::path& path,
                                              std::string_view text);

}  // namespace intarsia
