// A rebuilt surface as the pictures need it.
#pragma once

#include "kernels/quality/reconstruct.h"
#include "tools/picture/lines.h"
#include "tools/picture/shape.h"

namespace intarsia::tools {

// A view: points, triangles and patch labels in the colours of the patches. smooth: false for triangulations.
Shape shape_of(const kernels::Reconstruction& rebuilt, std::span<const Rgb> patch_colour, bool smooth);

// Borders between its patches.
Lines border_lines(const kernels::Reconstruction& rebuilt, const LineStyle& style);

}  // namespace intarsia::tools
