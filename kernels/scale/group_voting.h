// Surface variation of 64 neighbouring vertices at once: one walk for all, then one vertex per lane. What
// kernels/scale/voting_tensor.h computes for one vertex in double precision, in single precision: omega within 5e-6.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/instruction_set.h"
#include "engine/data/group_walk.h"
#include "kernels/scale/normal_cones.h"
#include "kernels/scale/voting_faces.h"
#include "kernels/scale/voting_tensor.h"

namespace intarsia::kernels {

// Arrays of one group and of one team of it, eight neighbouring sources; kernels/scale/group_voting.inc fills them.
struct GroupVotingScratch {
  struct alignas(64) Rings {
    std::uint8_t of[GroupWalker::kGroup];
  };
  struct alignas(32) Eight {
    float of[8];
  };
  struct alignas(16) Four {
    float of[4];
  };
  // Per vertex of the walk, and a last one that nobody reaches: how many of V_0 .. V_5 contain it, for every source
  // and as the most of every team, a byte each.
  std::vector<Rings> vertex_rings;
  std::vector<std::uint64_t> vertex_reach;
  // Per face of the walk: centroid and area; area * (xx, xy, xz, yy, yz, zz) of the normal; area * normal.
  std::vector<Four> centroid, normal;
  std::vector<Eight> vote;
  // Faces by team and by how many of N_1 .. N_6 contain it, every list with room for all.
  std::vector<std::uint16_t> bucket;
  std::array<std::array<std::uint16_t*, kRings + 1>, 8> bucket_end;
  // Of one team, ordered by the first ring that contains a face: the face, how many of N_1 .. N_6 contain it for each
  // lane, its distance from each lane.
  std::vector<std::uint16_t> face;
  std::vector<std::uint64_t> face_rings;
  std::vector<Eight> distance;

  void make_room(std::size_t vertices, std::size_t faces);
};

// One per thread at a time.
class GroupVoting {
 public:
  // The mesh and the faces must outlive this. `set` is for tests: every set gives the same bits.
  GroupVoting(const MeshView& mesh, std::span<const VotingFace> faces, bool fold_guard,
              InstructionSet set = instruction_set());

  // From now on, teams of eight that are flat by these cones get zeros instead of their variation, and are not voted
  // on.
  void skip(const FlatTeams& flat) { flat_ = flat; }

  // out[b] = variation of vertex first + b. Returns false, and fills nothing, where the neighbourhoods are too odd to
  // be walked together; that depends on the mesh only. Requires: 1 <= out.size() <= GroupWalker::kGroup.
  bool run(Index first, std::span<Variation> out);

 private:
  static constexpr Index kMostVertices = 4096, kMostFaces = 16384;

  bool normals_spread(std::span<const Index> faces) const;

  MeshView mesh_;
  std::span<const VotingFace> record_;
  bool fold_guard_;
  InstructionSet set_;
  GroupWalker walker_;
  GroupVotingScratch scratch_;
  FlatTeams flat_;
};

}  // namespace intarsia::kernels
