// What a report says about a layout (docs/formats.md).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "graph/artefacts.h"

namespace intarsia::graph {

// Adds counts, checks, the patch table and the hash over layout, labels and network.
void add_layout_report(nlohmann::json& report, const Soup& soup, const Surface& surface, const Network& network,
                       const Layout& layout, Index wanted_patches);

}  // namespace intarsia::graph
