// Proxies fitted to one region, with more seeds added where they are wanted: what dividing a region is made of.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/patches/fit_proxies.h"
#include "kernels/patches/relax_borders.h"

namespace intarsia::kernels {

class RegionFit {
 public:
  // Fits proxies to the graph from the given seeds. The graph must outlive this.
  RegionFit(const Work& work, const RegionGraph& graph, std::vector<Index> seed, const ProxyOptions& options);

  const ProxyFit& fit() const { return fit_; }
  Index regions() const { return fit_.regions(); }
  const std::vector<Index>& members(Index r) const { return members_[r]; }  // its nodes, ascending

  // One more seed, at the node of region r that fits its proxy worst (the next ones if what grows there is smaller than
  // options.least_share: slivers that a curve cuts off, with the normal of what lies on its other side). With few
  // regions all are fitted again, from the proxies they have; from eight on only r and its neighbours (all each time
  // their number doubles), beyond 64 r alone: a full round for each seed would make the whole quadratic. Returns the
  // regions that changed, the new one last; empty if r cannot be divided.
  std::vector<Index> add_seed(const Work& work, Index r, const ProxyOptions& options);
  // The same with all regions fitted again.
  bool add_seed_everywhere(const Work& work, Index r, const ProxyOptions& options);
  // Region of every face into regions.label, borders between them relaxed. `region` and `normal` are what the graph was
  // made with; its faces must have label 0, or labels of an earlier fit to the same region.
  void write(const Work& work, const PatchSurface& surface, const FaceVectors& normal, const Region& region,
             const GrowOptions& grow, const RelaxOptions& relax, Regions& regions) const;
  // Can region r take one more seed?
  bool can_divide(Index r) const { return worst_node(r) != kNone; }

 private:
  Index worst_node(Index r) const;
  bool add_everywhere(const Work& work, Index r, Index node, const ProxyOptions& options);
  void collect_members();
  std::vector<Index> add_locally(const Work& work, Index r, Index node, bool around, const ProxyOptions& options);

  const RegionGraph* graph_;
  ProxyFit fit_;
  std::vector<std::vector<Index>> members_;
  std::vector<std::uint8_t> odd_;  // per node: nothing grew around it
  std::vector<Index> rank_;        // scratch: place of each node in a part of the graph, kNone between calls
};

}  // namespace intarsia::kernels
