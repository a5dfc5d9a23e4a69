// Parts of a body by thickness and concave creases (after Shapira, Shamir, Cohen-Or 2008): a stand-in for the
// perceptual parts that the exoskeleton of de Goes et al. 2011 starts from.
#pragma once

#include <span>
#include <vector>

#include "kernels/baselines/face_graph.h"

namespace intarsia::kernels {

struct PartOptions {
  int clusters = 5;        // Gaussians over the logarithm of the diameter
  Real log_factor = 4;     // alpha of log(alpha x + 1)
  Real border = 2;         // lambda: price of one mean edge of border against one face in a doubtful cluster
  Real convex = 0.15;      // of the turn of a convex edge counts as concave
  Real least_area = 0.01;  // of the whole: smaller parts are merged
  Index most = 20;         // parts
};

// Gaussian mixture of values in one dimension, fitted by expectation maximisation from quantiles. Weighted.
struct Mixture {
  std::vector<Real> mean, deviation, share;
  Real density(int cluster, Real x) const;
};
Mixture fit_mixture(std::span<const Real> value, std::span<const Real> weight, int clusters);

// One label per face: clusters of `diameter`, with borders drawn to concave creases, in connected pieces.
PatchLabels segment_parts(const Work& work, const MeshView& mesh, const FaceGraph& graph,
                          std::span<const Real> diameter, const PartOptions& options);

}  // namespace intarsia::kernels
