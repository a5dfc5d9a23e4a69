// The surface as the patch kernels see it: areas, original normals, and the small holes that count as filled.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/data/curve_network.h"
#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// One vector per face, in single precision: half the memory.
struct SmoothNormals {
  std::array<std::vector<float>, 3> coordinate;

  std::size_t size() const { return coordinate[0].size(); }
};

// One vector per face, read through the face's parent where there is a list of parents.
class FaceVectors {
 public:
  FaceVectors() = default;
  FaceVectors(const Vec3View& of_face) : vector_(of_face) {}
  FaceVectors(const Vec3Array& of_face) : vector_(of_face) {}
  FaceVectors(const SmoothNormals& of_face)
      : single_{of_face.coordinate[0], of_face.coordinate[1], of_face.coordinate[2]} {}
  FaceVectors(const Vec3View& of_parent, std::span<const Index> parent) : vector_(of_parent), parent_(parent) {}

  // Zero for what is not finite.
  Vec3 operator[](Index f) const {
    if (!single_[0].empty()) return {single_[0][f], single_[1][f], single_[2][f]};
    const Vec3 v = vector_[parent_.empty() ? f : parent_[f]];
    return std::isfinite(v.x() + v.y() + v.z()) ? v : Vec3::Zero();
  }
  std::size_t size() const {
    return !single_[0].empty() ? single_[0].size() : parent_.empty() ? vector_.size() : parent_.size();
  }

 private:
  Vec3View vector_;
  std::span<const Index> parent_;
  std::array<std::span<const float>, 3> single_;
};

struct PatchSurface {
  MeshView mesh;
  const EdgeStrengths* strengths = nullptr;  // turn angle of the feature that an edge carries, 0 elsewhere
  std::vector<Real> area;                    // per face
  FaceVectors normal;  // per face: unit normal of its parent (a sliver has none of its own), or zero
  Real total_area = 0;
  Real mean_edge = 0;  // of the input mesh: refinement must not change what counts as thin
  Csr hole;            // short boundary loop -> its edges in order along the loop
  std::vector<std::pair<Index, Index>> hole_before;  // (edge, edge before it on its loop), sorted
  std::vector<std::uint8_t> beside_hole;             // per face: 1 if it has an edge on such a loop
  const RefinedMesh* refined = nullptr;
  std::span<const std::uint8_t> locked;  // per face: 1 where patches must stay whole (empty: nowhere); see lock()

  Index neighbour(Index f, int i) const { return mesh.other_face(mesh.face_edge[3 * f + i], f); }
  Vec3 centroid(Index f) const {
    const auto [a, b, c] = mesh.face(f);
    return (mesh.point(a) + mesh.point(b) + mesh.point(c)) / 3;
  }
  // Edges of curves that the user gave: no patch may grow across them.
  bool is_given(Index e) const { return refined->is_given(e); }
  bool is_locked(Index f) const { return !locked.empty() && locked[f] != 0; }
  Real strength(Index e) const { return strengths->empty() ? 0 : (*strengths)[e]; }
  Real edge_length(Index e) const { return (mesh.point(mesh.edge_v1[e]) - mesh.point(mesh.edge_v0[e])).norm(); }
  // The edge before e on its short boundary loop, or kNone if e is on none.
  Index before_on_hole(Index e) const;
};

// Requires: unit (or zero) parent normals, one per original face; mean_edge > 0. Keeps views of `refined`, of
// `parent_normal` and of `locked`: per refined face 1 where patches must not be divided, equal over each patch that the
// network encloses; empty: nowhere.
// hole_length: boundary loops of the surface shorter than this count as filled, unless a loop is longer
// than the square root of the area of its component: that is the outer border of a small piece.
PatchSurface make_patch_surface(const Work& work, const RefinedMesh& refined, Vec3View parent_normal, Real mean_edge,
                                Real hole_length = 0.05, std::span<const std::uint8_t> locked = {});

// Face normals averaged over `rounds` rings of edge neighbours with the same label, by area; at most unit length. What
// regions grow by: single noisy faces neither attract seeds nor fray borders. 0 rounds: the normals themselves.
SmoothNormals smooth_normals(const Work& work, const PatchSurface& surface, std::span<const Index> label, int rounds);

// The half-edge opposite corner c = 3 f + i runs from corner i+1 to corner i+2. This is the half-edge that follows it
// around its head, turning inside the faces for which crossing(edge) holds until it meets an edge that must not be
// crossed. across_hole(edge) gives, for a boundary edge that may be crossed, the boundary edge on the other side.
template <class Crossing, class AcrossHole>
Index next_border(const MeshView& mesh, Index c, const Crossing& crossing, const AcrossHole& across_hole) {
  Index f = c / 3, i = c % 3;
  for (Index steps = 0;; ++steps) {
    i = (i + 1) % 3;
    const Index e = mesh.face_edge[3 * f + i];
    if (!crossing(e)) return 3 * f + i;
    Index beyond = e, g = mesh.other_face(e, f);
    if (g == kNone) {
      beyond = across_hole(e);
      g = mesh.edge_f0[beyond];
    }
    f = g;
    for (i = 0; mesh.face_edge[3 * f + i] != beyond;) ++i;
    if (steps > mesh.face_count()) return 3 * f + i;  // cannot happen on a connected surface; never loop for ever
  }
}

}  // namespace intarsia::kernels
