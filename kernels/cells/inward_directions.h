// How the surface leaves an arc on one of its sides.
#pragma once

#include <span>

#include "engine/data/mesh.h"

namespace intarsia::kernels {

// Per point of an arc a unit vector, tangent to the surface beside the arc and normal to the arc, that leads away from
// it on its left (or right); zero where nothing tells. The surface's normals are those of the second ring of faces on
// that side, where the rounding of a ridge has ended, smoothed along the arc.
// vertex: the arc on the mesh; shape: where its points are taken to be, as many. Requires: two points at least.
void inward_directions(const MeshView& mesh, std::span<const Index> vertex, std::span<const Vec3> shape, bool left,
                       std::span<Vec3> inward);

}  // namespace intarsia::kernels
