// Breadth-first ring walk over a mesh, into scratch that the caller owns. Rings are walked, never stored: six rings are
// about 127 vertices, half a gigabyte per million.
//
// V_0 = {v}, V_j = vertices at graph distance exactly j. N_k = faces with a vertex at distance <= k - 1 (the union of
// the fans of all vertices within k - 1), so N_1 is the fan of v and N_(k-1) is a prefix of N_k.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/mesh.h"

namespace intarsia {

// One walker serves one thread at a time. It keeps 4 bytes per vertex and 4 per face, cleared once, not once per walk.
class RingWalker {
 public:
  static constexpr int kMaxRings = 32;
  static constexpr Index kFitCap = 512;       // points of a fit: poles of CAD meshes have hundreds of neighbours
  static constexpr Index kTensorCap = 16384;  // points under a voting tensor: a guard against quadratic time only

  // The mesh must outlive the walker. `barrier`: one flag per edge (or empty); a walk may reach the ends of a flagged
  // edge, but passes on from them only if it started there: it does not cross lines of flagged edges.
  explicit RingWalker(const MeshView& mesh, std::span<const std::uint8_t> barrier = {});

  // Walks V_1 .. V_rings of v in breadth-first order, rows ascending. A ring that would bring the points above `cap` is
  // dropped as a whole with all that follow (ring 1 is cut at `cap`). Invalidates all spans handed out before.
  // Requires: 0 <= rings <= kMaxRings.
  void walk(Index v, int rings, Index cap = kFitCap);
  // Adds rings to the walk just made.
  void extend(int rings, Index cap = kFitCap);
  // Collects N_1 .. N_(depth + 1) of the walk just made, in ring order, rows ascending. Call at most once per walk.
  void collect_faces(int rings);

  Index centre() const { return queue_[0]; }
  int depth() const { return depth_; }  // last ring walked; less than asked for where the cap or the component ended it
  // V_1 u ... u V_k without v, in breadth-first order. k above depth() gives all that was walked.
  std::span<const Index> vertices(int k) const { return {queue_.data() + 1, end_[clamped(k)] - 1}; }
  // V_k; empty above depth().
  std::span<const Index> ring(int k) const;
  // N_k; k above the number collected gives all of them.
  std::span<const Index> faces(int k) const { return {faces_.data(), face_end_[std::min(k, face_rings_)]}; }

 private:
  int clamped(int k) const { return k < depth_ ? k : depth_; }
  void new_epoch();

  MeshView mesh_;
  std::vector<std::uint8_t> stop_;  // vertices on barrier edges; empty without barriers
  std::vector<std::uint32_t> vertex_stamp_, face_stamp_;
  std::uint32_t epoch_ = 0;
  std::vector<Index> queue_, faces_;    // larger than what end_ and face_end_ say is in use
  Index end_[kMaxRings + 1] = {};       // end_[j]: queue size after ring j
  Index face_end_[kMaxRings + 1] = {};  // face_end_[k]: faces of N_k
  int depth_ = 0, face_rings_ = 0;
  bool capped_ = false;
};

}  // namespace intarsia
