// Variational shape approximation of a whole surface by K planes (Cohen-Steiner, Alliez, Desbrun 2004): the baseline
// that every comparison starts from. Sections 10 and 15.1.
#pragma once

#include <vector>

#include "kernels/baselines/face_graph.h"

namespace intarsia::kernels {

struct VsaOptions {
  Index patches = 40;
  int starts = 4;                           // of the four below; 1: the quickest of them
  int iterations = 50;                      // Lloyd steps from each start
  int teleport_every = 5;                   // steps between attempts to teleport; 0 = never
  Real tolerance = 1e-4;                    // relative gain of a round of steps that still counts
  Index coarse_faces = 40'000;              // more faces: balls of faces first, so many or 100 a patch
  std::size_t exchange_faces = 60'000'000;  // effort for exchanges at the end, in faces grown over
  bool area_in_key = false;                 // growing by A |n - N|^2 (paper) instead of |n - N|^2
};

struct VsaFit {
  std::vector<Index> region;  // per face, in 0 .. count - 1
  Index count = 0;
  Real energy = 0;            // sum over regions of 2 (A - |sum A n|)
  std::vector<Real> history;  // of the start that won: energy after each step
};

// Best of four deterministic starts (regions added a few at a time; seeds farthest in normal; 4 K regions by halving,
// merged down, which is the quickest; 12 K merged down), then teleports that only pay once the regions around them have
// adapted. Ensures: every region connected; count = min(patches, faces), but never below the number of components.
VsaFit fit_planes(const Work& work, const FaceGraph& graph, const VsaOptions& options);

}  // namespace intarsia::kernels
