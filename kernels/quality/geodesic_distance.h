// Distances along a surface by fast marching (Kimmel, Sethian 1998).
#pragma once

#include <span>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Distance of every vertex from the nearest source (all 0); infinity where none is reached. A front that would enter a
// triangle from outside goes along its edges instead: no distance is too small by more than the rule's own error, some
// are too large on obtuse triangles. Serial.
std::vector<Real> geodesic_distance(const Work& work, const MeshView& mesh, std::span<const Index> source);

}  // namespace intarsia::kernels
