// How far two surfaces are apart (Cignoni, Rocchini, Scopigno 1998, Metro), by deterministic dense sampling.
#pragma once

#include <vector>

#include "engine/space/triangle_tree.h"

namespace intarsia::kernels {

struct DistanceOptions {
  std::uint64_t samples = 1'000'000;  // on both surfaces together, half on each
  bool per_sample = false;            // keep every face sample
};

// From the samples of one surface to the other surface.
struct OneSided {
  Real max = 0, mean = 0, rms = 0;  // max includes vertices and edges; mean and rms weight samples by their area
  std::uint64_t samples = 0;
  Vec3 worst = Vec3::Zero();  // sample with the largest distance
};

struct SurfaceDistance {
  OneSided forward, backward;         // a to b, b to a
  std::vector<Real> face_rms;         // per triangle of a: root mean square of its samples (0 where it has none)
  std::vector<Real> vertex_distance;  // per point of a: distance to b; 0 for unused points

  Real hausdorff() const { return forward.max > backward.max ? forward.max : backward.max; }
  Real rms() const { return forward.rms > backward.rms ? forward.rms : backward.rms; }
  Real mean() const { return forward.mean > backward.mean ? forward.mean : backward.mean; }
};

// Requires: both with at least one triangle that has an area.
// Ensures: the same bits for any number of threads.
SurfaceDistance surface_distance(const Work& work, const TrianglesView& a, const TrianglesView& b,
                                 const DistanceOptions& options);

}  // namespace intarsia::kernels
