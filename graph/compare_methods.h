// Our layouts and those of the methods they are compared with, on one mesh at one number of patches: what the rows of
// the paper's Table 1 are made of.
#pragma once

#include <string>
#include <vector>

#include "graph/artefacts.h"
#include "graph/options.h"

namespace intarsia::graph {

// Where a method's patches come from.
enum class Method : std::uint8_t {
  compact,      // ours
  quality,      // ours
  faithful,     // ours: the paper's subdivision
  vsa,          // variational shape approximation of the whole mesh
  vsa_refined,  // its borders refined as compact does
  vsa_seeded,   // our seeds and border refinement on a mesh without features
  vsa_merged,   // three times as many proxies, merged and refined as quality does
  qse,
  exoskeleton,
  slippage,
};

std::vector<Method> all_methods();
std::string name_of(Method method);        // for tables: "VSA + merging"
std::string short_name_of(Method method);  // for files and flags: "vsa-merged"
bool is_ours(Method method);

// What the methods share: everything up to the candidates for curves.
struct Prepared {
  Surface surface;
  Sharp sharp;
  Curvature curvature;
  Curves curves;
};

Prepared prepare(const Work& work, const Soup& soup, const LayoutOptions& options);

// The layout of one method. The last stages (smoothing, embedding, checks) are the same for all.
// Requires: options.patches > 0.
Layout layout_by(const Work& work, const Prepared& prepared, Method method, const LayoutOptions& options);

}  // namespace intarsia::graph
