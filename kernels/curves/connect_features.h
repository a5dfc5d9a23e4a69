// From the raw lines of all channels to the feature curves of a surface: the order of the steps of this folder.
#pragma once

#include "engine/data/feature_curves.h"
#include "engine/parallel/work.h"
#include "kernels/curves/filter_curves.h"
#include "kernels/curves/join_ends.h"
#include "kernels/curves/measure_curves.h"
#include "kernels/curves/turn_angle.h"

namespace intarsia::kernels {

struct CurveOptions {
  bool paper = false;               // the paper's order: length, joining, then curvature and strength
  Real spur = 4;                    // in mean edges: side branches shorter than this are removed
  Real fragment = 2.5;              // in mean edges: lines with two loose ends shorter than this are removed
  Real fragment_without_sharp = 4;  // the same where the surface has no sharp edges
  Real tail_turn = 0.2;             // radians: loose ends are cut back to where the turn angle reaches this,
  Index tail_window = 7;            // as a mean over so many points
  TurnOptions turn;
  JoinOptions join;
  MeasureOptions measure;
  FilterOptions filter;
  PaperFilterOptions paper_filter;
};

// Paper mode sets every switch of the paper's letter.
CurveOptions paper_curve_options();

// Ridges, valleys and sharp edges as one set of curves: tidied, joined, trimmed, measured and ranked. Curves share
// point ids where they join. Robust: every curve that may still pass a saliency threshold is there;
// filter_by_saliency() selects. Paper: filtered. Requires: edge_length = mean edge length.
FeatureCurves connect_features(const Work& work, const MeshView& mesh, Real edge_length, const FeatureCurves& ridges,
                               const FeatureCurves& valleys, const FeatureCurves& sharp, const CurveOptions& options);

}  // namespace intarsia::kernels
