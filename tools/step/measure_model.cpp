#include "tools/step/measure_model.h"

namespace intarsia::tools {

ModelDeviation measure_model(const Work& work, const TrianglesView& mesh, std::span<const Index> label,
                             std::span<const Index> patch_face, const TrianglesView& model, std::span<const Index> face,
                             Index faces) {
  kernels::DistanceOptions options;
  options.samples = 400'000;
  const TriangleTree mesh_tree(work, mesh), model_tree(work, model);
  const kernels::SurfaceDistance there = kernels::surface_distance(work, mesh, mesh_tree, model, model_tree, options);
  const kernels::SurfaceDistance back = kernels::surface_distance(work, model, model_tree, mesh, mesh_tree, options);
  ModelDeviation out;
  out.to_face = there.forward.max, out.to_mesh = there.backward.max, out.rms = there.rms(), out.mean = there.mean();
  out.face.resize(faces);
  std::vector<Index> face_of(label.size());
  for (std::size_t t = 0; t < label.size(); ++t) face_of[t] = patch_face[label[t]];
  const auto to_face = kernels::distance_per_label(there, face_of, faces);
  const auto to_mesh = kernels::distance_per_label(back, face, faces);
  for (Index f = 0; f < faces; ++f) out.face[f] = {to_face[f].max, to_mesh[f].max, to_face[f].rms, to_mesh[f].area};
  return out;
}

}  // namespace intarsia::tools
