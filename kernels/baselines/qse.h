// Segmentation of a whole surface by K quadrics (after Yan, Liu, Wang 2006, "Quadric surface extraction by variational
// shape approximation", and Yan, Wang, Liu, Yang 2012, "Variational mesh segmentation via quadric surface fitting").
// Section 15.2. The error of a face and the ladder of types are our reading of it.
#pragma once

#include <vector>

#include "kernels/baselines/face_graph.h"
#include "kernels/baselines/quadric.h"

namespace intarsia::kernels {

struct QseOptions {
  Index patches = 40;
  int iterations = 30;       // Lloyd steps
  int teleport_every = 5;    // steps between attempts to teleport; 0 = never
  Real normal_weight = 0.1;  // w; times the mean area of a patch
  Index overshoot = 3;       // starts from so many times K planes, merged by their quadrics
  Index samples = 400;       // faces of a region that its fit looks at
  Real same_within = 0;      // regions whose union keeps its error below become one, a length; 0 = K stay K
  Real tolerance = 1e-3;     // relative gain of a round of steps that still counts
};

struct QseFit {
  std::vector<Index> region;  // per face
  std::vector<Quadric> quadric;
  Real energy = 0;  // sum of A (d^2 + w h^2 |n - grad f / |grad f||^2)

  Index count() const { return static_cast<Index>(quadric.size()); }
};

// Ensures: every region connected; count = min(patches, faces), but never below the number of components, or fewer
// where regions are pieces of one quadric (same_within).
QseFit fit_quadrics(const Work& work, const MeshView& mesh, const FaceGraph& graph, const QseOptions& options);

}  // namespace intarsia::kernels
