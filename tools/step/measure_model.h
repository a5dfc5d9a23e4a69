// How far a model is from the layout it was made of, face by face.
#pragma once

#include <vector>

#include "engine/parallel/work.h"
#include "kernels/quality/surface_distance.h"

namespace intarsia::tools {

struct FaceDeviation {
  Real to_face = 0;  // largest distance from the patch's mesh to the model
  Real to_mesh = 0;  // from the face to the mesh
  Real rms = 0;      // from the patch's mesh to the model
  Real area = 0;     // of the face
  Real largest() const { return to_face > to_mesh ? to_face : to_mesh; }
};

struct ModelDeviation {
  std::vector<FaceDeviation> face;  // of the model
  Real to_face = 0, to_mesh = 0, rms = 0, mean = 0;
  Real largest() const { return to_face > to_mesh ? to_face : to_mesh; }
};

// mesh and triangles in the same units. patch_face: position in the model's faces per patch, or kNone.
ModelDeviation measure_model(const Work& work, const TrianglesView& mesh, std::span<const Index> label,
                             std::span<const Index> patch_face, const TrianglesView& model, std::span<const Index> face,
                             Index faces);

}  // namespace intarsia::tools
