// The frame every later length is measured in: bounding-box centre at 0, bounding-box diagonal 1.
#pragma once

#include "engine/base/types.h"
#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// input position = centre + diagonal * normalised position.
struct BoxTransform {
  Vec3 centre = Vec3::Zero();
  Real diagonal = 1;

  // + 0.0 folds -0 into 0, so that equal positions have equal bits.
  Vec3 to_unit(const Vec3& p) const { return ((p - centre) / diagonal).array() + 0.0; }
  Vec3 to_input(const Vec3& p) const { return centre + diagonal * p; }
};

// Box of the vertices that faces use; a stray unused vertex does not change the scale.
// Requires: corner ids below vertex_count.
// Ensures: the same bits for any order of vertices and faces (minima and maxima only).
// Errors: rejected if there is no face, a used coordinate is not finite (element = vertex), or the diagonal is 0 or
// overflows.
BoxTransform normalise_box(const Work& work, const Soup& soup);

}  // namespace intarsia::kernels
