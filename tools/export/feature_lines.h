// The feature curves of a run as polylines with the paper's measures: the raw lines before any filter, and the curves
// that were chosen for the network.
#pragma once

#include "graph/artefacts.h"

namespace intarsia::tools {

struct FeatureLines {
  // Per line. length, in the input's units; L, R and T are those of the paper (Eq. 7) at a bounding-box diagonal of 1,
  // R and T -1 where they are not known (of chosen lines).
  std::vector<CurveKind> kind;
  std::vector<std::uint8_t> chosen;  // 0 raw, 1 chosen
  std::vector<Real> length, L, R, T;
  std::vector<std::size_t> offset{0};  // line -> its points

  // Per point: place in the input's units; of raw lines the curvature across the line (1 / unit) and the mean distance
  // of the points that it was fitted to, which is the scale that was chosen; 0 on chosen lines.
  std::vector<Vec3> point;
  std::vector<Real> curvature, radius;

  // The closed network before its patches were made: two points for each edge.
  std::vector<Vec3> network;
  std::vector<CurveKind> network_kind;  // per edge

  std::size_t count() const { return kind.size(); }
};

FeatureLines feature_lines(const Work& work, const graph::Surface& surface, const graph::Ridges& ridges,
                           const graph::Ridges& valleys, const graph::Sharp& sharp, const graph::Network& network);

}  // namespace intarsia::tools
