// view.html: a layout to look at in any browser, in one file that needs nothing else, not even a network.
#pragma once

#include <optional>

#include "tools/export/handover.h"

namespace intarsia::tools {

inline constexpr std::size_t kPageFaces = 500'000;  // a run writes the page by itself up to here

// Distances of a rebuilt surface, for the page's last stage. Lengths in diagonals.
struct PageDeviation {
  std::span<const Real> vertex;  // per vertex of the input
  std::vector<Real> patch_rms;
  Real top = 1;  // of the colour scale
  std::string caption;
};

// Parts of an earlier page of the same layout, for what only the run knew.
struct PageParts {
  std::string features, deviation, deviation_meta;
};
// Errors: none; parts that are not there are empty.
PageParts read_page_parts(const std::filesystem::path& path);

struct PageOptions {
  std::size_t most_faces = kPageFaces;  // larger surfaces are shown coarser
  const PageDeviation* deviation = nullptr;
  PageParts earlier;  // taken where the handover has no feature lines, or there is no deviation
};

// Errors: write_failed naming the file; cancelled.
void write_page(const Work& work, const std::filesystem::path& path, const Handover& handover,
                const PageOptions& options = {});

}  // namespace intarsia::tools
