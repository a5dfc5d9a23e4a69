// The lines of view.html again, as numbers: what the page knows of a run before its patches.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "engine/data/curve_network.h"
#include "tools/view/page_data.h"

namespace intarsia::tools {

struct PageLines {
  std::vector<CurveKind> kind;
  std::vector<std::size_t> offset{0};  // line -> its points
  std::vector<Vec3> point;             // in the units of the grid's mesh

  std::size_t count() const { return kind.size(); }
  std::span<const Vec3> line(std::size_t l) const {
    return std::span(point).subspan(offset[l], offset[l + 1] - offset[l]);
  }
};

struct PageFeatures {
  PageLines raw, chosen;
};

// bytes: as the page has them, decoded. Errors: bad_file naming the page where they are damaged.
PageFeatures page_features(const std::filesystem::path& page, std::string_view bytes, const PageGrid& grid);

// Errors: bad_file if there is no page, no lines in it, or they are damaged; it says which command writes them.
PageFeatures read_page_features(const std::filesystem::path& page, const PageGrid& grid);

}  // namespace intarsia::tools
