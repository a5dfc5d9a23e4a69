// Removal of what is too short to mean anything: spurs, fragments and faint tails; and of points no curve uses.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/feature_curves.h"
#include "engine/data/weld_chains.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// How often curves touch each point: 1 for each end of a curve (a closed one has two), 2 for passing through.
// A point with 1 is a loose end.
std::vector<Index> point_uses(const FeatureCurves& curves);

Real curve_length(const MeshView& mesh, const FeatureCurves& curves, Index c);

// Replaces the chains; kind and channel come from the source curve. Measures are dropped.
void replace_chains(FeatureCurves& curves, WeldedChains chains);

// The curves with keep[c] != 0 in their order, points compacted in theirs. Measures and components are carried over;
// components keep their numbers.
FeatureCurves select_curves(const Work& work, const FeatureCurves& curves, std::span<const std::uint8_t> keep);

// All curves of several sets, first come first; points are not merged. Measures are dropped.
FeatureCurves merge_channels(std::span<const FeatureCurves* const> sets);

// Ridges and valleys from a loose end to a junction that are shorter than max_length. Where only two curves of one kind
// are left at a point they become one.
void remove_spurs(const Work& work, const MeshView& mesh, Real max_length, FeatureCurves& curves);

// Ridges and valleys whose two ends are loose, or that are closed, and that are shorter than min_length.
void remove_fragments(const Work& work, const MeshView& mesh, Real min_length, FeatureCurves& curves);

// Cuts loose ends of ridges and valleys back to where the mean turn angle of `window` points reaches min_turn; a curve
// that never does is removed if an end of it is loose. Repeats while that frees other ends.
void trim_tails(const Work& work, Real min_turn, Index window, FeatureCurves& curves);

}  // namespace intarsia::kernels
