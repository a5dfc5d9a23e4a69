// Breadth-first ring walks of up to 64 neighbouring vertices at once: one walk over all that any of them reaches, and
// one bit per source vertex. The bit words are the lane masks of the kernels that run one vertex per lane.
//
// Source b of a group that starts at `first` is vertex first + b. V_j and N_k as in engine/data/k_ring.h: the walk of
// every source is the one that RingWalker would make, barriers included, only the order of the points differs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/mesh.h"

namespace intarsia {

// One walker serves one thread at a time.
class GroupWalker {
 public:
  static constexpr Index kGroup = 64;
  static constexpr int kMaxRings = 8;
  using Mask = std::uint64_t;

  // The mesh must outlive the walker. `barrier`: one flag per edge, or empty (engine/data/k_ring.h).
  explicit GroupWalker(const MeshView& mesh, std::span<const std::uint8_t> barrier = {});

  // Walks `rings` rings of vertices first .. first + count - 1. Invalidates all spans handed out before.
  // Requires: 1 <= count <= kGroup, 0 <= rings <= kMaxRings.
  void walk(Index first, Index count, int rings);
  // Finds the faces of N_1 .. N_rings of the walk just made. Requires: as many rings or one less were walked.
  void collect_faces(int rings);

  // All that is at most k rings from any source; the sources come first, in their order. vertices(k) is a prefix of
  // vertices(k + 1).
  std::span<const Index> vertices(int k) const;
  // Bit b of within(k)[i]: vertices(k)[i] is at most k rings from source b (source b itself included).
  std::span<const Mask> within(int k) const;
  // Faces of N_k of any source; faces(k) is a prefix of faces(k + 1).
  std::span<const Index> faces(int k) const;
  // Bit b of face_within(k)[i]: faces(k)[i] is in N_k of source b.
  std::span<const Mask> face_within(int k) const;
};

}  // namespace intarsia
