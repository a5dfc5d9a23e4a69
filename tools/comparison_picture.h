// The picture of a comparison: a column per method, a row per mesh (and two more for what was rebuilt).
#pragma once

#include "graph/compare_methods.h"
#include "graph/evaluate.h"
#include "tools/comparison.h"
#include "tools/picture/sheet.h"

namespace intarsia::tools {

// What of one method on one mesh is drawn.
struct DrawnMethod {
  graph::Layout layout;
  graph::Evaluation evaluation;
};

// Input, then the layouts of the methods with their triangulated R and median q, the least R in bold; rebuilt: below
// them the triangulated and the filled surfaces with H and R instead.
// Requires: as many methods in `numbers` as drawn.
Image draw_comparison(const Work& work, const graph::Surface& surface, const MeshNumbers& numbers,
                      const std::vector<DrawnMethod>& drawn, bool rebuilt, const SheetOptions& options);

// The rows of several meshes with the names of the methods above and an explanation below.
Image join_comparisons(const std::vector<Image>& rows, const std::vector<std::string>& methods,
                       const SheetOptions& options);

}  // namespace intarsia::tools
