// Teleports of variational shape approximation judged by what they come to after the neighbours have adapted: three
// strips around a bore cost less than two of four merged into one.
#pragma once

#include "kernels/baselines/normal_regions.h"

namespace intarsia::kernels {

struct ExchangeOptions {
  int steps = 4;           // Lloyd steps of the regions around a cut or a merge
  std::size_t tries = 12;  // cuts and merges that are neighbours, tried on the whole surface
  Real tolerance = 1e-4;   // of the total energy: less is no gain
};

// Cuts regions and merges pairs of others, each with its neighbours adapted, as long as their neighbourhoods do not
// touch and the energy falls; if there is nothing of the kind, the best of some neighbouring ones. Returns how many;
// the energy is lower by at least the tolerance then. work: cuts and merges are tried side by side.
Index exchange_regions(const Work& work, const FaceGraph& graph, NormalRegions& regions,
                       const ExchangeOptions& options);

}  // namespace intarsia::kernels
