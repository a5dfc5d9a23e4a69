// Patches as nodes, shared borders as links: what a union of two patches would be, without touching a face.
// Every quantity is additive under merging (moments, lengths, counts of shared edges and vertices), so a candidate
// costs O(1) and a merge costs the size of the two rows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/patch_labels.h"
#include "kernels/patches/patch_surface.h"

namespace intarsia::kernels {

// What patch p shares with patch `other`.
struct Border {
  Index other = kNone;
  Index edges = 0;         // 0: they touch in vertices only and cannot merge
  std::int32_t euler = 0;  // edges - vertices that only these two share + short holes that only these two surround
  Real length = 0;
  Real salience = 0;  // integral of theta^2 ds
  Index given = 0;    // edges of curves that the user gave: with any, the two stay apart

  bool may_vanish() const { return edges > 0 && given == 0; }
};

struct PatchNode {
  Real area = 0, perimeter = 0;
  Vec3 normal_sum = Vec3::Zero();
  std::int32_t euler = 0;
  Index first_face = kNone;
  Index version = 0;  // counts merges: tells stale queue entries
  bool alive = true;
  std::vector<Border> borders;  // ascending by other
  std::vector<Index> meetings;  // vertices (and short holes) where this and at least two more patches meet

  // L2,1 energy about the best proxy: 2 (A - |sum A n|).
  Real energy() const { return 2 * std::max(Real{0}, area - normal_sum.norm()); }
  // Distance from being a disc in units of the Euler characteristic.
  int defect() const { return euler > 1 ? euler - 1 : 1 - euler; }
};

class PatchGraph {
 public:
  PatchGraph(const Work& work, const PatchSurface& surface, const PatchLabels& labels);

  Index size() const { return static_cast<Index>(node_.size()); }
  Index alive() const { return alive_; }
  const PatchNode& operator[](Index p) const { return node_[p]; }

  // Euler characteristic of the union of p and the patch across one of its borders. With a border left, the union is a
  // disc exactly if this is 1.
  int union_euler(Index p, const Border& border) const;
  Real union_energy_increase(Index p, const Border& border) const;
  Real union_perimeter(Index p, const Border& border) const;

  // Joins two live patches that share edges; returns the id that stays.
  Index merge(Index p, Index q);

  // The patch that p has become part of.
  Index survivor(Index p) const;
  PatchLabels labels(const Work& work, const PatchLabels& before) const;

 private:
  struct Meeting {
    std::vector<Index> patches;  // at least three, ascending
    bool is_vertex;
  };
  void add_links(const Work& work, const PatchSurface& s, const PatchLabels& labels);
  void add_meetings(const Work& work, const PatchSurface& s, const PatchLabels& labels);
  void add_touch(std::vector<Index>& patches, bool is_vertex);
  void add_euler(Index p, Index q, int euler);
  Border& border_between(Index p, Index q);

  std::vector<PatchNode> node_;
  std::vector<Meeting> meeting_;
  std::vector<Index> into_;
  Index alive_ = 0;
};

}  // namespace intarsia::kernels
