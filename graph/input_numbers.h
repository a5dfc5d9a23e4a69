// From the surface's canonical numbers back to those of the input.
#pragma once

#include <vector>

#include "engine/io/write_layout.h"
#include "graph/artefacts.h"

namespace intarsia::graph {

// A view of its arguments, which must outlive it; without colours.
LayoutView layout_view(const Soup& soup, const Surface& surface, const Layout& layout);

// Vertex of the surface for every vertex of the input: the first of its copies, that of the one it was welded to; kNone
// where there is none.
std::vector<Index> surface_vertices(const Work& work, const Soup& soup, const Surface& surface);

}  // namespace intarsia::graph
