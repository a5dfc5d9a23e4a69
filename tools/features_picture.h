// The chosen scales as a picture, with chosen vertices marked.
#pragma once

#include <optional>
#include <span>

#include "graph/artefacts.h"
#include "tools/picture/camera.h"
#include "tools/picture/image.h"

namespace intarsia::tools {

// Faces coloured by the ring that their vertices are fitted in by the rule, 1 to 6, with a bar that explains it.
// marked: vertices in the input's numbers; they get circles and the letters A, B, C ...
// Errors: bad_argument if a marked vertex does not exist or no face uses it.
Image draw_scales(const Work& work, const graph::Surface& surface, const graph::Scale& scale,
                  std::span<const Index> marked, const std::optional<View>& view);

}  // namespace intarsia::tools
