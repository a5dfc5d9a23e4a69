// The methods that layouts are compared with: segmentations of the surface that do not look at feature curves, brought
// to patches and then to a layout by the same last stages as our own.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "engine/run/node.h"
#include "graph/empty_network.h"
#include "graph/layout_graph.h"

namespace intarsia::graph {

enum class Baseline : std::uint8_t {
  vsa,          // variational shape approximation, Cohen-Steiner, Alliez, Desbrun 2004
  qse,          // quadric surface extraction, Yan, Liu, Wang 2006
  exoskeleton,  // VSA part by part, after de Goes, Goldenstein, Desbrun, Velho 2011
  slippage,     // local slippage analysis, after Gelfand, Guibas 2004
};

// As in tables: with "-like" where the original's details are not known to us.
const char* name_of(Baseline method);

// One label per face of the surface; every label connected, `patches` of them where the surface allows.
// parts: per face of the surface, what the exoskeleton starts from; empty = parts by shape diameter. Connected pieces
// of equal numbers are parts. Errors: bad_argument if there is not one part number per face.
std::vector<Index> baseline_labels(const Work& work, const Surface& surface, Baseline method, Index patches,
                                   std::span<const Index> parts = {});

// The same as patches. network: empty_network of the surface.
Patches baseline_patches(const Work& work, const Surface& surface, const Network& network, Baseline method,
                         Index patches, std::span<const Index> parts = {});

struct BaselinePorts {
  FeaturePorts features;
  Port<Network> network;
  Port<Patches> patches;
  Port<Layout> layout;
};

// Adds all stages from surface to layout; the feature stages serve the smoothing of borders alone, as in our own
// layouts. parts: gives one number per triangle of the soup; empty: none are given.
using PartsOfSoup = std::function<std::vector<Index>(const Soup& soup)>;
BaselinePorts add_baseline_stages(Flow& flow, const Port<Soup>& soup, const LayoutOptions& options, Baseline method,
                                  PartsOfSoup parts = {});

}  // namespace intarsia::graph
