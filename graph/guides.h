// What the user wants kept: curves that must become borders, and regions that must stay patches as they are.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/parallel/work.h"
#include "graph/artefacts.h"

namespace intarsia::graph {

// In the coordinates and numbers of the input.
struct GivenGuides {
  std::vector<std::vector<Vec3>> curve;  // polylines on or near the surface
  std::vector<int> pin;                  // per triangle: region, negative where it is free; empty: all are
};

// Where they come from; nothing by default. hash: of what `read` will return, for checkpoints.
struct GuideSource {
  std::function<GivenGuides(const Soup&)> read;
  std::uint64_t hash = 0;
};

// Errors: rejected, bad_argument if the pins are not one for each triangle of the input.
Guides surface_to_guides(const Work& work, const Surface& surface, const GivenGuides& given);

}  // namespace intarsia::graph
