// deviation.ply of a result folder again: how far each triangle of the input is from the rebuilt surface.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/parallel/work.h"

namespace intarsia::tools {

// The face property distance_rms, in the units of the file, one for each triangle.
// Errors: bad_file, also where there is no such file (the message says which command writes it).
std::vector<Real> read_face_deviation(const Work& work, const std::filesystem::path& path);

}  // namespace intarsia::tools
