// Merging patches: tiny and thin ones first of all, later the cheapest pairs down to a wanted number.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "kernels/patches/patch_graph.h"

namespace intarsia::kernels {

struct MergeOptions {
  Real tiny_area = 8e-4;    // of the whole area; smaller patches merge
  Real tiny_width = 2;      // mean edge lengths; patches with 2 A / P below merge
  Real widest_tiny = 0.04;  // but none that are wider than this, diagonals: a cube of twelve triangles has six sides
  Real crease = 1;          // nor any whose border turns by more, radians (root mean square)
  Real salience_weight = 0.02;  // per integral of theta^2 ds along the border that would vanish
  Real border_reward = 0.01;    // per length of the border that would vanish
  Real compactness = 0.02;      // times A max(0, P^2 / (4 pi A) - free_winding) of the union, minus that of the parts
  Real free_winding = 4;        // P^2 / (4 pi A): 1 is a circle, 1.27 a square, about 4 a 1 : 10 strip
  bool keep_discs = false;      // true: refuse unions that are farther from a disc than their parts
};

// Price of taking down the border between p and the patch across it; may be negative. Areas are relative to the
// diagonal squared, lengths to the diagonal (1).
Real merge_cost(const PatchGraph& graph, Index p, const Border& border, const MergeOptions& options);

bool is_tiny(const PatchGraph& graph, Index p, const PatchSurface& surface, const MergeOptions& options);

// Merges every tiny patch, smallest first, into the neighbour with the cheapest cost; unions that lose a disc come
// last (or never, with keep_discs). A tiny patch that is a whole component stays.
// Order: (area, id), then (loses a disc, cost, id). Returns the number of merges.
Index merge_tiny(const Work& work, const PatchSurface& surface, const MergeOptions& options, PatchGraph& graph);

// Merges cheapest pairs first until `target` patches are left or no pair is allowed. allowed(p, border) must depend on
// the two patches only. Order: (cost, smaller id, larger id).
void merge_cheapest(const Work& work, const MergeOptions& options, Index target,
                    const std::function<bool(Index, const Border&)>& allowed, PatchGraph& graph);

PatchLabels merge_patches(const Work& work, const PatchSurface& surface, const PatchLabels& labels,
                          const MergeOptions& options);

// How many patches a network leaves after the tiny merge: flooding and merging without writing labels. What a budget
// bisection calls again and again.
Index count_after_merge(const Work& work, const PatchSurface& surface, std::span<const std::uint8_t> on_network,
                        const MergeOptions& options);

}  // namespace intarsia::kernels
