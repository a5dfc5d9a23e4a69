// Length, curvature and strength of curves (Cao, Yan, Wonka 2014, Eq. 7).
#pragma once

#include "engine/data/feature_curves.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct MeasureOptions {
  bool plain_mean = false;  // R as the mean over points (paper mode) instead of along the length
};

// Fills length L, rms_curvature R (mean of sqrt((kmax^2 + kmin^2) / 2)), strength T (L times the integral of
// `extremality`, trapezoid rule) and saliency (integral of the turn angle) of every curve.
// Scaling x -> s x gives L -> s L, R -> R / s, T -> T.
void measure_curves(const Work& work, const MeshView& mesh, const MeasureOptions& options, FeatureCurves& curves);

}  // namespace intarsia::kernels
