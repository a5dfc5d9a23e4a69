// Gentle darkening of hollows, estimated from the picture's own depths.
#pragma once

#include <vector>

#include "tools/picture/raster.h"

namespace intarsia::tools {

// openness[pixel] in [0, 1]: 1 in the open, lower where the neighbourhood of the pixel rises towards the viewer
// (screen-space obscurance after Mittring 2007 and McGuire et al. 2011, smoothed across the sampling pattern).
// radius: in pixels, as a fraction of the picture's longer side.
void open_sky(const Work& work, const Shape& shape, const Frame& frame, float radius, std::vector<float>& openness);

}  // namespace intarsia::tools
