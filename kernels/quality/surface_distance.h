// How far two surfaces are apart (Cignoni, Rocchini, Scopigno 1998, Metro), by deterministic dense sampling.
#pragma once

#include <vector>

#include "engine/space/triangle_tree.h"

namespace intarsia::kernels {

struct DistanceOptions {
  std::uint64_t samples = 1'000'000;  // on both surfaces together, half on each; every face gets at least one
  bool per_sample = false;            // keep every face sample
  Real tolerance = 1e-3;  // of the maximum: sought until known so well, or a sixteenth of the samples is spent on it
};

// From the samples of one surface to the other surface.
struct OneSided {
  Real max = 0;               // largest distance found: vertices, face samples, refinement where larger ones may hide
  Real bound = 0;             // no point of the surface is farther (up to rounding); max if nothing is left to find
  Real mean = 0, rms = 0;     // over the area: face samples weigh their face's area / number of its samples
  Real area = 0;              // of the surface
  std::uint64_t samples = 0;  // face samples
  Vec3 worst = Vec3::Zero();  // where max was found
  Index worst_triangle = kNone;  // of the surface it lies on
};

// The face samples of one surface, face by face in an order that keeps neighbours together.
struct DistanceSamples {
  Vec3Array point;
  std::vector<Real> distance;
  std::vector<Index> triangle;
};

struct SurfaceDistance {
  OneSided forward, backward;                        // a to b, b to a
  std::vector<Real> face_area, face_mean, face_rms;  // per triangle of a; mean and rms of its samples, 0 without area
  std::vector<Real> face_max;                        // largest distance of its samples and corners
  std::vector<Real> vertex_distance;                 // per point of a: distance to b; 0 for unused points
  DistanceSamples forward_sample, backward_sample;   // empty unless asked for

  Real hausdorff() const { return forward.max > backward.max ? forward.max : backward.max; }
  Real rms() const { return forward.rms > backward.rms ? forward.rms : backward.rms; }
  Real mean() const { return forward.mean > backward.mean ? forward.mean : backward.mean; }
};

// Requires: both with at least one triangle that has an area; finite points.
// Ensures: the same bits for any number of threads.
// Errors: rejected if a surface has no area.
SurfaceDistance surface_distance(const Work& work, const TrianglesView& a, const TrianglesView& b,
                                 const DistanceOptions& options);

// The same with trees that the caller has built over a and b, to be used again.
SurfaceDistance surface_distance(const Work& work, const TrianglesView& a, const TriangleTree& a_tree,
                                 const TrianglesView& b, const TriangleTree& b_tree, const DistanceOptions& options);

// What a part of surface a contributes.
struct PartDistance {
  Real area = 0, mean = 0, rms = 0, max = 0;
};

// Per label of a's triangles. Requires: one label below `labels` per triangle, or kNone for none.
std::vector<PartDistance> distance_per_label(const SurfaceDistance& distance, std::span<const Index> label,
                                             Index labels);

}  // namespace intarsia::kernels
