// Which features stand out: connected components of curves are judged as a whole.
#pragma once

#include "engine/data/feature_curves.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Angles in radians, lengths in units of the bounding-box diagonal.
struct FilterOptions {
  Real min_turn = 0.3;     // mean turn angle along the component; more on coarse meshes, see connect_features
  Real min_length = 0.03;  // of the component
  // Mean of -k'' / kd^3 along the component. On cylinders noise alone reaches about 1, at a modest turn; where the
  // surface is folded over, real crests have less.
  Real min_sharpness = 1.2;     // at a mean turn of up to unfolded_turn
  Real folded_sharpness = 0.7;  // from folded_turn on; linear between
  Real unfolded_turn = 0.8;
  Real folded_turn = 1.2;
};

// The paper's thresholds on each curve (R and T at diagonal 1).
struct PaperFilterOptions {
  Real min_length = 0.023;
  Real min_curvature = 12.158;
  Real min_strength = 0.252;
};

// Fills component, component_saliency and component_passed: 1 if the component passes every test but that of its
// saliency, 2 if it holds a sharp curve, 0 otherwise. Only ridges and valleys are averaged.
// Requires: measures filled. Ensures: components numbered by their first curve.
void rank_components(const Work& work, const FilterOptions& options, FeatureCurves& curves);

// The curves of ranked components with at least min_saliency, and sharp curves always. Cheap: a search for a threshold
// calls it again and again on the same ranked curves.
FeatureCurves filter_by_saliency(const Work& work, const FeatureCurves& ranked, Real min_saliency);

// Paper mode, first step and last: curves with L, and those with R and T, at least as large as the thresholds.
FeatureCurves filter_by_length(const Work& work, const FeatureCurves& measured, Real min_length);
FeatureCurves filter_by_strength(const Work& work, const FeatureCurves& measured, const PaperFilterOptions& options);

}  // namespace intarsia::kernels
