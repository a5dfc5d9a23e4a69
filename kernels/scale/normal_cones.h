// Where surface variation is certainly small, without voting: normals that all lie close to one axis.
//
// With every normal at most an angle t from an axis, the largest eigenvalue of any sum of w n n^T is at least
// cos^2 t of its trace, so (l2 + l3) / l1 <= tan^2 t whatever the weights. Angles are kept as chords |n - axis|, which
// add up without trigonometry.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/group_walk.h"
#include "engine/data/mesh.h"
#include "engine/parallel/work.h"
#include "kernels/scale/voting_faces.h"

namespace intarsia::kernels {

// Around all normals of the faces at a vertex that vote.
struct alignas(16) NormalCone {
  float axis[3];  // unit; 0 where no face votes
  float chord;    // the largest from the axis; -4 where no face votes: below anything
};

std::vector<NormalCone> normal_cones(const Work& work, const MeshView& mesh, std::span<const VotingFace> faces);

// Where normals are closer than this chord to an axis, variation is below `variation`, rounding included.
float safe_chord(Real variation);

// Sources of a group by eights: a bit for every team whose faces all have normals within `inner` of one axis as far as
// N_inner_rings, and within `outer` as far as N_outer_rings.
struct FlatTeams {
  std::span<const NormalCone> cone;  // per vertex; empty: nothing is known to be flat
  float inner = 0, outer = 0;        // chords
  int inner_rings = 0, outer_rings = 0;

  // Sources first .. first + count - 1, after GroupWalker::meet: true if all are flat.
  bool all(const GroupWalker& walker, Index first, Index count) const;
  // After GroupWalker::reach: bit t for sources 8 t .. 8 t + 7.
  std::uint32_t some(const GroupWalker& walker, Index first, Index count) const;
};

}  // namespace intarsia::kernels
