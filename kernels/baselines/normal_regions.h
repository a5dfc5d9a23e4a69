// Regions of faces with their mean normals, and the moves between numbers of regions (L2,1 metric of Cohen-Steiner,
// Alliez, Desbrun 2004).
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "kernels/baselines/face_queue.h"

namespace intarsia::kernels {

struct NormalRegions {
  std::vector<Index> region;  // per face
  std::vector<Real> area;     // per region
  std::vector<Vec3> sum;      // per region: sum of area times unit normal

  Index count() const { return static_cast<Index>(area.size()); }
  // sum of A |n - N|^2 for the best N, in closed form: 2 (A - |sum A n|).
  Real energy(Index r) const { return energy_of(area[r], sum[r]); }
  Real total() const;
  static Real energy_of(Real a, const Vec3& s) { return std::max(Real{0}, 2 * (a - s.norm())); }
};

// Energy of any labelling, ids below `count`.
Real normal_energy(const FaceGraph& graph, std::span<const Index> region, Index count);

// Sums of the regions 0 .. count - 1.
void refit(const FaceGraph& graph, NormalRegions& regions, Index count);

// One Lloyd step: every region grows anew from its best-fitting face with its mean normal as proxy.
// Requires: one region at least in every component of the graph. Ensures: regions connected, sums up to date.
void regrow(const Work& work, const FaceGraph& graph, NormalRegions& regions, FaceQueue& queue, bool area_in_key);

// The same, but only faces within `rings` steps of another region are given up and grown again, so that what a region
// has reached past badly fitting faces is not lost.
void regrow_borders(const Work& work, const FaceGraph& graph, NormalRegions& regions, FaceQueue& queue, int rings);

// Every region cut in two: side of each face (0 or 1), and what the energy would fall by, per region; negative where a
// region cannot be cut. Both sides connected.
struct Halves {
  std::vector<std::uint8_t> side;
  std::vector<Real> gain;
};
Halves cut_in_two(const Work& work, const FaceGraph& graph, const NormalRegions& regions, FaceQueue& queue);

// Cuts the regions that gain most (ties: larger area, lower id) until there are `count`, each at most once.
void split_best(const Work& work, const FaceGraph& graph, NormalRegions& regions, Index count, FaceQueue& queue);

// Merges the cheapest adjacent pair until `count` are left or nothing is adjacent. Ties: lower ids.
void merge_cheapest(const Work& work, const FaceGraph& graph, NormalRegions& regions, Index count);

// Adjacent pairs, the one whose union costs least first (ties: lower ids).
struct Merge {
  Real loss;
  Index a, b;
  bool operator<(const Merge& o) const { return std::tie(loss, a, b) < std::tie(o.loss, o.a, o.b); }
};
std::vector<Merge> merges_by_loss(const FaceGraph& graph, const NormalRegions& regions);
// Regions in the order in which cutting them gains most.
std::vector<Index> order_by_gain(std::span<const Real> gain);

// Regions b of the merges become part of a; the other side of region cut[i] takes the id that merge[i] frees.
// Requires: all regions named are different; connected halves.
void move_regions(const FaceGraph& graph, NormalRegions& regions, std::span<const Merge> merge,
                  std::span<const Index> cut, std::span<const std::uint8_t> side);

// Teleportation: merges pairs and cuts other regions instead wherever that lowers the energy. Returns how many.
Index teleport(const Work& work, const FaceGraph& graph, NormalRegions& regions, FaceQueue& queue);

}  // namespace intarsia::kernels
