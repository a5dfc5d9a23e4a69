#include "kernels/scale/voting_faces.h"

#include "engine/parallel/for_each.h"
#include "kernels/scale/voting_tensor.h"

namespace intarsia::kernels {

std::vector<VotingFace> voting_faces(const Work& work, const MeshView& mesh) {
  std::vector<VotingFace> out(mesh.face_count());
  for_each(work, Cost::light, out.size(), [&](std::size_t f) {
    const FaceRecord r = face_record(mesh, static_cast<Index>(f));
    for (int i = 0; i < 3; ++i) {
      out[f].centroid[i] = static_cast<float>(r.centroid[i]);
      out[f].normal[i] = static_cast<float>(r.normal[i]);
    }
    out[f].area = static_cast<float>(r.area);
    out[f].zero = 0;
  });
  return out;
}

}  // namespace intarsia::kernels
