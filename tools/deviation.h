// A surface coloured by its distance from another one: as a PLY file and as a picture.
#pragma once

#include <filesystem>

#include "engine/data/mesh.h"
#include "kernels/quality/surface_distance.h"
#include "tools/picture/camera.h"
#include "tools/picture/colour_map.h"

namespace intarsia::tools {

// One surface in the user's coordinates, and the distances measured in units of `diagonal`.
struct Deviation {
  const Soup& soup;
  const kernels::SurfaceDistance& distance;
  Real diagonal = 1;
};

// 0 to a round number of percents of the diagonal that all but half a percent of the area stay below.
ColourScale deviation_scale(const Deviation& deviation);

// Vertices with float distance (units of the file) and uchar red green blue; faces with float distance_rms.
void write_deviation_ply(const Work& work, const std::filesystem::path& path, const Deviation& deviation,
                         const ColourScale& scale);

// The surface from `view` and from behind, faces coloured by the root mean square of their distances, above the bar.
Image draw_deviation(const Work& work, const Deviation& deviation, const ColourScale& scale, const View& view);

}  // namespace intarsia::tools
