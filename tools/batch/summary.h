// The summary of a batch: one line per mesh, as CSV, JSON and a page with pictures.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/batch/item.h"

namespace intarsia::tools {

struct SummaryCount {
  std::size_t done = 0, degraded = 0, failed = 0, missing = 0;
};

// Writes summary.csv, summary.json, summary.html and failed.txt (paths of meshes without a layout, a list for another
// batch) from the records of all items. Shards that end at the same time take turns.
// Errors: write_failed.
SummaryCount write_summary(const std::filesystem::path& results, const std::vector<BatchItem>& items);

}  // namespace intarsia::tools
