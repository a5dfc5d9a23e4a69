// Variational shape approximation of a whole surface by K planes (Cohen-Steiner, Alliez, Desbrun 2004): the baseline
// that every comparison starts from. Sections 10 and 15.1.
#pragma once

#include <vector>

#include "kernels/baselines/face_graph.h"

namespace intarsia::kernels {

struct VsaOptions {
  Index patches = 40;
  int iterations = 50;       // Lloyd steps from each start
  int teleport_every = 5;    // steps between attempts to teleport; 0 = never
  Real tolerance = 1e-4;     // relative gain of a round of steps that still counts
  Index overshoot = 4;       // one start merges so many times K regions down to K
  bool area_in_key = false;  // growing by A |n - N|^2 (paper) instead of |n - N|^2
};

struct VsaFit {
  std::vector<Index> region;  // per face, in 0 .. count - 1
  Index count = 0;
  Real energy = 0;            // sum over regions of 2 (A - |sum A n|)
  std::vector<Real> history;  // of the start that won: energy after each step
};

// Best of three deterministic starts: regions halved until there are K, seeds farthest in normal, and many regions
// merged down. Ensures: every region connected; count = min(patches, faces), but never below the number of components.
VsaFit fit_planes(const Work& work, const FaceGraph& graph, const VsaOptions& options);

}  // namespace intarsia::kernels
