// Variational shape approximation of one region: Lloyd iterations of growing and refitting (L2,1 metric of
// Cohen-Steiner, Alliez, Desbrun 2004).
#pragma once

#include <span>
#include <vector>

#include "kernels/patches/grow_regions.h"

namespace intarsia::kernels {

struct ProxyOptions {
  GrowOptions grow;
  int max_iterations = 20;
  Real tolerance = 1e-4;  // relative drop of the energy that still counts
  int patience = 3;       // Lloyd with growing is not monotone: give up after so many rounds without a gain
  Real least_share = 0;   // a region that is added must take so much of the area of the one that it is added to
};

struct ProxyFit {
  std::vector<Index> label;   // per node
  std::vector<Index> seed;    // per region: its best-fitting node
  std::vector<Vec3> proxy;    // unit sum of A n, or zero
  std::vector<Real> area;     // per region
  std::vector<Real> energy;   // per region: 2 (A - |sum A n|)
  std::vector<Real> history;  // total energy after each iteration

  Index regions() const { return static_cast<Index>(seed.size()); }
  Real total() const;
};

// Best of all iterations from the given seeds. proxy: first proxies, one per seed; empty = the seeds' own normals.
// Requires: at least one seed, all different.
ProxyFit fit_proxies(const Work& work, const RegionGraph& graph, std::vector<Index> seed, std::vector<Vec3> proxy,
                     const ProxyOptions& options);

// Deterministic first seeds: the node farthest from the mean normal, then the one farthest from that; further ones
// farthest from all before (ties: smaller id). At most `count`, fewer if the graph has fewer nodes.
std::vector<Index> farthest_normals(const RegionGraph& graph, Index count);

}  // namespace intarsia::kernels
