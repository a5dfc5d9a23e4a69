// A good direction to look from, found from the geometry alone.
#pragma once

#include "tools/picture/camera.h"

namespace intarsia::tools {

// Tries directions all around, slightly above the horizon, on a coarse sample of the faces, and keeps the one that
// shows most of the surface, most variety of normals and most creases (after Vazquez et al. 2001 and Secord et al.
// 2011); of nearly equal ones the lower and the one from the model's front (z for y up, -y for z up). The vertical is y
// or z, whichever lets the object stand better; y where that does not decide.
// Requires: at least one face.
// Ensures: depends on the geometry only; ties go to the earlier candidate.
View best_view(const Work& work, const Shape& shape);

}  // namespace intarsia::tools
