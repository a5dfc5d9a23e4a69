// Breadth-first ring walks of up to 64 neighbouring vertices at once: one walk over all that any of them reaches, and
// one bit per source vertex. The bit words are the lane masks of the kernels that run one vertex per lane.
//
// Source b of a group that starts at `first` is vertex first + b. V_j and N_k as in engine/data/k_ring.h: the walk of
// every source is the one that RingWalker would make, barriers included, only the order of the points differs.
// The multi-source search after Then et al. 2014 ("The more the merrier: efficient multi-source graph traversal").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/mesh.h"

namespace intarsia {

// One walker serves one thread at a time. It keeps 4 bytes per vertex, and 4 per face once faces were asked for,
// cleared once, not once per walk.
class GroupWalker {
 public:
  static constexpr Index kGroup = 64;
  static constexpr int kMaxRings = 8;
  using Mask = std::uint64_t;

  // The mesh must outlive the walker. `barrier`: one flag per edge, or empty (engine/data/k_ring.h).
  explicit GroupWalker(const MeshView& mesh, std::span<const std::uint8_t> barrier = {});

  // Walks `rings` rings of vertices first .. first + count - 1. Invalidates all spans handed out before.
  // Returns false, and then nothing may be asked, if more than `most` vertices are met: neighbourhoods so odd (poles of
  // CAD meshes) that walking together does not pay. Requires: 1 <= count <= kGroup, 0 <= rings <= kMaxRings.
  bool walk(Index first, Index count, int rings, Index most = kNone) {
    if (!meet(first, count, rings, most)) return false;
    reach();
    return true;
  }
  // The two halves of walk(), for those who may have seen enough after the first: vertices() only, then the rest.
  bool meet(Index first, Index count, int rings, Index most = kNone);
  void reach();
  // Finds the faces of N_1 .. N_rings of the walk just made. Requires: as many rings or one less were walked.
  void collect_faces(int rings);

  // All that is at most k rings from any source; the sources come first, in their order. vertices(k) is a prefix of
  // vertices(k + 1). The place of a vertex is its position in vertices(rings).
  std::span<const Index> vertices(int k) const { return {queue_.data(), end_[level(k)]}; }
  // Bit b of within(k)[i]: vertices(k)[i] is at most k rings from source b (source b itself included).
  std::span<const Mask> within(int k) const { return {within_[level(k)].data(), end_[level(k)]}; }
  // Faces of N_k of any source; faces(k) is a prefix of faces(k + 1).
  std::span<const Index> faces(int k) const { return {faces_.data(), face_end_[static_cast<std::size_t>(k)]}; }
  // Bit b of face_within(k)[i]: faces(k)[i] is in N_k of source b. Found on demand: ask once per walk and k.
  std::span<const Mask> face_within(int k);
  // Places of the three corners of face i of the list; places().size() == vertices(rings).size() stands for "not met".
  std::span<const std::array<Index, 3>> face_places() const {
    return {face_places_.data(), face_end_[static_cast<std::size_t>(face_rings_)]};
  }

 private:
  static constexpr std::size_t kRow = 8;

  std::size_t level(int k) const { return static_cast<std::size_t>(k < rings_ ? k : rings_); }
  void new_epoch();
  template <bool add>
  void look_around(Index begin, Index end);
  void spread(std::size_t k);

  MeshView mesh_;
  std::vector<std::uint8_t> stop_;  // vertices on barrier edges; empty without barriers
  // Vertices: base_ + place in the walk that met them last. Faces: number of that walk.
  std::vector<std::uint32_t> vertex_stamp_, face_stamp_;
  std::uint32_t base_ = 1, walk_ = 0;
  Index count_ = 0, size_ = 0;  // sources, vertices met

  // The lists are longer than what is in use, so that a row can be written before it is known what of it counts.
  std::vector<Index> queue_, faces_;
  std::vector<Index> near_;  // kRow places of neighbours per vertex below the last level, some repeated
  struct LongRow {
    Index place, begin, end;  // of far_
  };
  std::vector<LongRow> long_rows_;  // vertices with more than kRow neighbours, in order
  std::vector<Index> far_;          // places of their neighbours
  std::array<std::vector<Mask>, kMaxRings + 1> within_;
  std::vector<Mask> passes_;  // what a vertex hands on; only with barriers
  std::array<std::vector<Mask>, kMaxRings + 2> face_within_;
  std::vector<std::array<Index, 3>> face_places_;
  std::array<Index, kMaxRings + 1> end_{};
  std::array<Index, kMaxRings + 2> face_end_{};
  int rings_ = 0, face_rings_ = 0;
};

}  // namespace intarsia
